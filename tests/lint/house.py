#!/usr/bin/env python3
"""Compares the drawing of the house (docs/design/house.md) with the code: folders, and who includes what.

usage: house.py SOURCE_DIR              exit 1 and one line per violation
       house.py SOURCE_DIR --self-test  plants one violation of each rule in a copy and expects to find it

A line of the drawing is: folder [package, ...]  what it is for -> folders that it may include
Indentation says in which folder a folder lies; `*` stands for any text. layers.py reads the packages.
"""
import re
import shutil
import sys
import tempfile
from fnmatch import fnmatch
from pathlib import Path

DRAWING = "docs/design/house.md"
ROOMS = ("tools", "lib")  # what the drawing holds; an include begins with a folder of one of these
FENCE = re.compile(r"^```house\n(.*?)^```", re.M | re.S)
LINE = re.compile(
    r"^(?P<indent> *)(?P<name>[\w*-]+)(?: \[(?P<packages>[^\]]+)\])?(?:  +(?P<what>.*?))?(?: *-> (?P<arrows>.*))?$")
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.M)
SUFFIXES = {".h", ".hpp", ".cpp", ".cc", ".inl"}


def sources(folder):
    return sorted(p for p in folder.rglob("*") if p.suffix in SUFFIXES) if folder.is_dir() else []


def includes(path):
    """(line number, header) of every include of a file."""
    text = path.read_text(encoding="utf-8", errors="replace")
    return [(text.count("\n", 0, m.start()) + 1, m.group(1)) for m in INCLUDE.finditer(text)]


def lies_in(folder, outer):
    """Is `folder` the folder `outer`, or inside it? `outer` may hold `*`."""
    return fnmatch(folder, outer) or fnmatch(folder, outer + "/*")


class Room:
    """A line of the drawing. `name` is the path below lib or tools: "meshing", "geometry/import", "st-*"."""

    def __init__(self, top, name, match, number):
        self.top, self.name, self.number = top, name, number
        self.packages = [p.strip() for p in (match["packages"] or "").split(",") if p.strip()]
        self.arrows = (match["arrows"] or "").split()
        self.has_purpose = bool(match["what"])


class House:
    """The drawing: rooms from top to bottom."""

    def __init__(self, root):
        text = (root / DRAWING).read_text(encoding="utf-8")
        fence = FENCE.search(text)
        if not fence:
            sys.exit(f"{DRAWING}: no drawing: a block that begins with ```house")
        first = text.count("\n", 0, fence.start(1)) + 1
        self.rooms, self.faults, stack = [], [], []
        for number, line in enumerate(fence.group(1).splitlines(), first):
            match = LINE.match(line)
            if not match:
                self.faults.append(f"{DRAWING}:{number}: not of the form: folder  what for -> folders")
                continue
            while stack and len(stack[-1][0]) >= len(match["indent"]):
                stack.pop()
            stack.append((match["indent"], match["name"]))
            path = [name for _, name in stack]
            if len(path) > 1:
                self.rooms.append(Room(path[0], "/".join(path[1:]), match, number))

    def allowed(self, folder):
        """Folders that `folder` may include: what its own line names, and the lines of the folders around it."""
        return [a for r in self.rooms if lies_in(folder, r.name) for a in r.arrows]


def folder_of(path, root):
    """Path of a source's folder below lib or tools."""
    return path.parent.relative_to(root).as_posix().split("/", 1)[1]


def target_of(header, root):
    """Folder of a header of the project; None for any other."""
    for top in ROOMS:
        if (root / top / header).is_file():
            return Path(header).parent.as_posix()
    return None


def all_includes(root):
    """(where, folder, header, folder of the header) of every include of a header of the project in another folder."""
    for top in ROOMS:
        for path in sources(root / top):
            folder = folder_of(path, root)
            for line, header in includes(path):
                target = target_of(header, root)
                if target and target != folder:
                    yield f"{path.relative_to(root)}:{line}", folder, header, target


def folder_violations(root, house):
    folders = {(top, folder_of(p, root)) for top in ROOMS for p in sources(root / top)}
    for top, folder in sorted(folders):
        if not any(r.top == top and fnmatch(folder, r.name) for r in house.rooms):
            yield f"{top}/{folder}: not in the drawing {DRAWING}; add a line that says what it is for"
    for r in house.rooms:
        where = f"{DRAWING}:{r.number}: {r.top}/{r.name}"
        if not any(top == r.top and lies_in(folder, r.name) for top, folder in folders):
            yield f"{where}: no such folder with sources"
        if not r.has_purpose:
            yield f"{where}: says not what it is for"


def arrow_violations(root, house):
    used = set()
    for where, folder, header, target in all_includes(root):
        named = [a for a in house.allowed(folder) if lies_in(target, a)]
        used |= {(r.name, a) for r in house.rooms if lies_in(folder, r.name) for a in r.arrows if lies_in(target, a)}
        if not named:
            yield f"{where}: {folder} must not include {header}: no such arrow in {DRAWING}"
    for r in house.rooms:
        below = {s.name for s in house.rooms if s.number > r.number}
        for a in r.arrows:
            where = f"{DRAWING}:{r.number}: {r.name} -> {a}"
            if a not in below:
                yield f"{where}: arrows point to folders that are drawn further down"
            elif (r.name, a) not in used:
                yield f"{where}: no include uses this arrow; take it out"


def violations(root):
    house = House(root)
    return [*house.faults, *folder_violations(root, house), *arrow_violations(root, house)]


def copy_of(root, folder):
    """The parts of the source tree that lints read, copied."""
    for part in ROOMS:
        shutil.copytree(root / part, Path(folder) / part)
    (Path(folder) / DRAWING).parent.mkdir(parents=True)
    shutil.copy(root / DRAWING, Path(folder) / DRAWING)
    return Path(folder)


def plant(root, name, text):
    (root / name).parent.mkdir(parents=True, exist_ok=True)
    (root / name).write_text(text)


def draw(root, old, new):
    drawing = root / DRAWING
    text = drawing.read_text(encoding="utf-8")
    assert re.search(old, text, re.M), old
    drawing.write_text(re.sub(old, new, text, count=1, flags=re.M), encoding="utf-8")


def plants(name, text):
    return lambda root: plant(root, name, text)


def plants_include(name, layer):
    """A source that includes a header of a layer, wherever that lies in it."""
    def change(root):
        header = next(p for p in sources(root / "lib" / layer) if p.suffix == ".h")
        plant(root, name, f'#include "{header.relative_to(root / "lib").as_posix()}"\n')
    return change


def draws(old, new):
    return lambda root: draw(root, old, new)


def plant_tool_that_includes_a_tool(root):
    plant(root, "tools/st-info/planted.h", "")
    plant(root, "tools/st-mesh/planted.cpp", '#include "st-info/planted.h"\n')


# What is wrong: how it is planted, and what must be said of it.
PLANTS = {
    "an include that no arrow allows": (
        plants_include("lib/base/planted.cpp", "geometry"), "lib/base/planted.cpp:1"),
    "an include between two sides": (
        plants_include("lib/geometry/planted.cpp", "mesh"), "lib/geometry/planted.cpp:1"),
    "an include of another leg": (
        plants_include("lib/io/planted.cpp", "comm"), "lib/io/planted.cpp:1"),
    "an include of a tool by a library": (
        plants("lib/stages/planted.cpp", '#include "common/tool_main.h"\n'), "lib/stages/planted.cpp:1"),
    "an include of a tool by a tool": (plant_tool_that_includes_a_tool, "tools/st-mesh/planted.cpp:1"),
    "a layer that is not drawn": (plants("lib/odd/planted.cpp", "\n"), "lib/odd: not in the drawing"),
    "a folder in a layer that is not drawn": (
        plants("lib/base/odd/planted.h", "\n"), "lib/base/odd: not in the drawing"),
    "a tool outside the pattern": (plants("tools/odd/main.cpp", "\n"), "tools/odd: not in the drawing"),
    "a drawn folder that is not there": (
        draws(r"^  base", "  attic  for old things\n  base"), "lib/attic: no such folder"),
    "an arrow that nothing uses": (draws(r"^(  comm .*->)", r"\1 geometry"), "comm -> geometry: no include uses"),
    "an arrow that points up": (draws(r"^(  base\s.*)$", r"\1 -> stages"), "base -> stages: arrows point"),
    "a folder without a purpose": (draws(r"^  base\s.*$", "  base"), "lib/base: says not"),
    "a line that is no folder": (draws(r"^  base", "  ???\n  base"), "not of the form"),
}


def self_test(root):
    missed = []
    for name, (change, expected) in PLANTS.items():
        with tempfile.TemporaryDirectory() as folder:
            copy = copy_of(root, folder)
            change(copy)
            if not any(expected in v for v in violations(copy)):
                missed.append(name)
    return [f"self test: planted violation not found: {m}" for m in missed]


def main(find, test):
    root = Path(sys.argv[1]).resolve()
    found = test(root) if "--self-test" in sys.argv[2:] else find(root)
    print("\n".join(found) or "no violation")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(violations, self_test))
