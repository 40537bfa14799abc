"""What the lints share: files, exemption lists that may only shrink, functions as ctags sees them, planted violations.

A lint is a module with `check(root)`, which yields one line per violation, and PLANTS: changes that must each give one.
"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

SKIPPED = {"build", "out", ".git", ".cache", "__pycache__"}
EXEMPTIONS = "tests/lint/exempt"


class Plant(NamedTuple):
    """Text to append to a file (made where it is missing), and what the violation found then must contain."""
    path: str
    text: str
    expected: str


def files(root, *suffixes, under=("",)):
    """Paths relative to root with one of these suffixes, ascending."""
    found = set()
    for folder in under:
        for where, folders, names in os.walk(root / folder):
            folders[:] = [f for f in folders if f not in SKIPPED]
            found |= {str((Path(where) / name).relative_to(root)) for name in names if name.endswith(suffixes)}
    return sorted(found)


def sources(root, under=("lib", "tools", "tests", "bench", "examples")):
    return files(root, ".h", ".cpp", under=under)


def exempt(root, name):
    """Entries of tests/lint/exempt/NAME.txt; text behind # is a remark."""
    path = root / EXEMPTIONS / f"{name}.txt"
    lines = path.read_text(encoding="utf-8").splitlines() if path.is_file() else []
    return [entry for entry in (line.split("#")[0].strip() for line in lines) if entry]


def without_exempt(root, name, found):
    """Violations but for the exempt entries, and one per entry needed no longer. found: {entry: [violations]}."""
    listed = exempt(root, name)
    for entry in sorted(set(found) - set(listed)):
        yield from found[entry]
    for entry in listed:
        if entry not in found:
            yield f"{EXEMPTIONS}/{name}.txt: {entry} needs no exemption; remove the line"


def write_exempt(root, name, found):
    """Removes what is needed no longer; a list that does not exist is made of all that is found today."""
    path = root / EXEMPTIONS / f"{name}.txt"
    if not path.is_file():
        path.parent.mkdir(exist_ok=True)
        path.write_text("".join(f"{entry}\n" for entry in sorted(found)), encoding="utf-8")
        return
    lines = path.read_text(encoding="utf-8").splitlines()
    kept = [line for line in lines if not line.split("#")[0].strip() or line.split("#")[0].strip() in found]
    path.write_text("".join(line + "\n" for line in kept), encoding="utf-8")


class Function(NamedTuple):
    name: str
    path: str
    line: int
    end: int
    is_definition: bool
    is_lambda: bool


def functions(root, paths):
    """Functions of C++ files as universal-ctags finds them: definitions and declarations."""
    command = ["ctags", "--output-format=json", "--languages=C++", "--map-C++=+.h", "--kinds-C++=fp", "--fields=+ne",
               "-f", "-", "-L", "-"]
    done = subprocess.run(command, cwd=root, input="\n".join(paths), capture_output=True, text=True, check=True)
    for tag in map(json.loads, done.stdout.splitlines()):
        name, line = tag["name"], tag["line"]
        is_lambda = name.startswith("__anon")
        yield Function(name, tag["path"], line, tag.get("end", line), tag["kind"] == "function", is_lambda)


def without_comments(text):
    """C++ text with comments and contents of strings blanked; lines stay where they are."""
    pattern = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.S)
    return pattern.sub(lambda m: re.sub(r"[^\n]", " ", m.group()), text)


def copy_of(root, folder):
    copy = Path(folder) / "copy"
    shutil.copytree(root, copy, ignore=lambda _, names: SKIPPED & set(names), symlinks=True)
    return copy


def self_test(root, check, plants):
    """One line per plant that gives no violation."""
    with tempfile.TemporaryDirectory() as folder:
        copy = copy_of(root, folder)
        for plant in plants:
            path = copy / plant.path
            path.parent.mkdir(parents=True, exist_ok=True)
            before = path.read_text(encoding="utf-8") if path.is_file() else None
            path.write_text((before or "") + plant.text, encoding="utf-8")
            if not any(plant.expected in violation for violation in check(copy)):
                yield f"self test: not found: {plant.expected}"
            if before is None:
                path.unlink()
            else:
                path.write_text(before, encoding="utf-8")


def main(check, plants, update=None):
    """usage: LINT.py SOURCE_DIR [--self-test | --update]; --update shortens the exemption list."""
    root = Path(sys.argv[1]).resolve()
    if "--update" in sys.argv[2:] and update:
        update(root)
        return 0
    found = list(self_test(root, check, plants) if "--self-test" in sys.argv[2:] else check(root))
    print("\n".join(found) or "no violation")
    return 1 if found else 0
