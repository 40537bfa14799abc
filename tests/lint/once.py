#!/usr/bin/env python3
"""Ideas that the code has once: each stands in the one file that is named here, and nowhere else in lib and tools.

A new idea is a row of ONCE: what it is, how its code looks, and the file to use instead. What is to be nowhere is a row
of NEVER, with what to do instead. What may be a few times is a row of FEW, with the most there may be: a ceiling that
only falls. Files of lib that are longer than LONG lines are at most MOST_LONG, classes with more than LARGE members
at most MOST_LARGE.
"""
import json
import re
import subprocess
import sys
from collections import Counter

import lint

ONCE = [
    ("union-find", r"while \((\w+)\[(\w+)\] != \2\)|(\w+) = (\w+)\[\3\] = \4\[\4\[\3\]\]", "lib/base/disjoint_sets.h"),
    ("what is near a box", r"([\w.>-]+)(?:\.|->)(?:lo|hi)\.(\*?\w+) [<>]=? (?!\1\b)[\w.>-]+(?:\.|->)(?:lo|hi)\.\2\b"
     r"(?! [*/?]).*(?:&&|\|\|)", "lib/base/boxes.h"),
    ("a search for triangles that cross", r"\b(?:find_bounded|PairSearch)\b", "lib/mesh/triangle_tree.cpp"),
    ("cutting regions into tiles and joining them", r"(?:share_cuts|mesh_groups)\(\w*executor",
     "lib/meshing/engine/region_tasks.cpp"),
    ("when refining stops", r"constexpr \S+ kLoopFloor =|constexpr \S+ k(?:FewCrossings|"
     r"MostRepeated|ClearlyFewer|PerFailure|MostForWalls) =", "lib/meshing/engine/refinement_policy.h"),
    ("what counts as the same", r"constexpr double k(?:AboutSameArea|SameArea|SamePlace|Harmless) =",
     "lib/geometry/model/sameness.h"),
    ("whether a place is finite", r"\bbool is_finite\(|isfinite\(\w+(?:\.\w+)*\.x\)", "lib/base/finite.h"),
    ("the axis along which a box is longest", r"\.x >= \w+\.y && \w+\.x >= \w+\.z \? 0", "lib/base/axis.h"),
    ("a triangle that has a node twice", r"\bbool has_repeated_node\(", "lib/mesh/adjacency.h"),
    ("what a section's nodes are called in the mesh of all", r"inner_begin\[\w+\.section\]|< n_own_? \? .*\+ \w+ :",
     "lib/mesh/merge.cpp"),
    ("whether a face is joined to another", r"\bloops\((?:[^()]|\([^()]*\))*\)\.empty\(\)",
     "lib/geometry/model/model.h"),
]
# what, how its code looks, in which headers, how often at most, and what to use instead
FEW = [
    ("types with triangles of their own", r"std::vector<Triangle> \w+;|std::vector<std::int32_t> corners;",
     ("lib/mesh", "lib/meshing"), 3, "FacePatch, or FaceMesh in a Piece"),
    ("addresses of patches", r"(?m)^struct (?:\w*Place\w* \{\n  FaceId face|FacePlace|Placed\w+|\w+Begin)\b",
     ("lib/mesh/patch", "lib/meshing/engine"), 1, "PatchPlace"),
    ("weldings", r"(?m)^(?:struct|class) \w*(?:Numbers|Welder)\b", ("lib/mesh",), 1, "PatchNumbers"),
    ("keys of nodes", r"(?m)^(?:enum class \w*Key : std::int|(?:inline )?std::int64_t \w+_key\()", ("lib/",), 1,
     "NodeKey"),
]
NEVER = [
    ("a summary's JSON parsed again", r"parse\([\w.>-]*(?:summary|association)[\w.>-]*json", "pass its values"),
    ("faces at edges by offsets", r"(?:\.|->)edge_faces\((?!offsets_, faces_\))", "use EdgeFaces"),
    ("tasks without the names of their fields", r"\brun_named_tasks\(\s*\{\s*[^.\s]", "write {.order = ...}"),
]
LONG, MOST_LONG = 400, 10
LARGE, MOST_LARGE = 15, 8


known_members = {}  # text of a file -> names of its classes, and how many members each has


def large_classes(root):
    """Names of classes with more than LARGE members, as universal-ctags counts them."""
    texts = {path: (root / path).read_text(encoding="utf-8") for path in lint.sources(root, under=("lib", "tools"))}
    new = {path: text for path, text in texts.items() if text not in known_members}
    command = ["ctags", "--output-format=json", "--languages=C++", "--map-C++=+.h", "--kinds-C++=m", "-f", "-", "-L",
               "-"]
    done = subprocess.run(command, cwd=root, input="\n".join(new), capture_output=True, text=True, check=True)
    known_members.update((text, Counter()) for text in new.values())
    for tag in map(json.loads, done.stdout.splitlines()):
        known_members[texts[tag["path"]]][tag.get("scope")] += 1
    members = [known_members[text].items() for text in texts.values()]
    return sorted(scope for classes in members for scope, n in classes if scope and n > LARGE)


def check_few(root):
    for what, pattern, under, most, instead in FEW:
        n = sum(len(re.findall(pattern, lint.without_comments((root / path).read_text(encoding="utf-8"))))
                for path in lint.sources(root, under=("lib",)) if path.startswith(under) and path.endswith(".h"))
        if n != most:
            yield f"lib: {n} {what}, {most} in tests/lint/once.py; " + (f"use {instead}" if n > most else "correct it")


def check(root):
    n_long = sum(len((root / path).read_text(encoding="utf-8").splitlines()) > LONG
                 for path in lint.sources(root, under=("lib",)))
    if n_long > MOST_LONG:
        yield f"lib: {n_long} files are longer than {LONG} lines, at most {MOST_LONG} may be; make one simpler"
    large = large_classes(root)
    if len(large) > MOST_LARGE:
        yield f"lib: {len(large)} classes have more than {LARGE} members, at most {MOST_LARGE} may: {', '.join(large)}"
    yield from check_few(root)
    for path in lint.sources(root, under=("lib", "tools")):
        text = lint.without_comments((root / path).read_text(encoding="utf-8"))
        for what, pattern, instead in NEVER:
            for match in re.finditer(pattern, text):
                yield f"{path}:{text.count(chr(10), 0, match.start()) + 1}: {what}; {instead}"
        for what, pattern, home in ONCE:
            if path == home:
                continue
            for match in re.finditer(pattern, text):
                yield f"{path}:{text.count(chr(10), 0, match.start()) + 1}: {what} is written in {home}; use that"
    for what, pattern, home in ONCE:
        if not (root / home).is_file() or not re.search(pattern, (root / home).read_text(encoding="utf-8")):
            yield f"{home}: {what} is not written here any more; correct tests/lint/once.py"


PLANTS = [
    lint.Plant("lib/mesh/planted.cpp", "void f() { while (p[i] != i) i = p[i]; }\n", "planted.cpp:1: union-find"),
    lint.Plant("lib/mesh/planted.cpp", "void f() { i = p[i] = p[p[i]]; }\n", "planted.cpp:1: union-find"),
    lint.Plant("lib/mesh/planted.cpp", "f = a.lo.x <= b.hi.x && b.lo.x <= a.hi.x;\n", "planted.cpp:1: what is near"),
    lint.Plant("lib/mesh/planted.cpp", "f = a.lo.*k > b->hi.*k || b.lo.*k > a.hi.*k;\n", "planted.cpp:1: what is near"),
    lint.Plant("lib/mesh/planted.cpp", "PairSearch found(most);\n", "planted.cpp:1: a search for triangles"),
    lint.Plant("lib/meshing/planted.cpp", "tiled.share_cuts(executor_);\n", "planted.cpp:1: cutting regions"),
    lint.Plant("lib/mesh/planted.cpp", "constexpr double kLoopFloor = 0.1;\n", "planted.cpp:1: when refining stops"),
    lint.Plant("lib/mesh/planted.cpp", "constexpr double kSameArea = 1;\n", "planted.cpp:1: what counts as the same"),
    lint.Plant("lib/mesh/planted.cpp", "if (t.loops(f).empty()) return;\n", "planted.cpp:1: whether a face is joined"),
    lint.Plant("lib/mesh/planted.cpp", "auto j = json::parse(summary.json);\n", "planted.cpp:1: a summary's JSON"),
    lint.Plant("lib/mesh/planted.cpp", "run_named_tasks(\n  {order, {}, {}});\n", "planted.cpp:1: tasks without"),
    lint.Plant("lib/mesh/planted.cpp", "bool is_finite(Vec3 p) {}\n", "planted.cpp:1: whether a place is finite"),
    lint.Plant("lib/mesh/planted.cpp", "return std::isfinite(n.uv.x);\n", "planted.cpp:1: whether a place is finite"),
    lint.Plant("lib/mesh/planted.cpp", "k = d.x >= d.y && d.x >= d.z ? 0 : 1;\n", "planted.cpp:1: the axis along"),
    lint.Plant("lib/mesh/planted.cpp", "bool has_repeated_node(Triangle);\n", "planted.cpp:1: a triangle that has"),
    lint.Plant("lib/mesh/planted.cpp", "return n < n_own ? first + n : foreign[n - n_own];\n",
               "planted.cpp:1: what a section's nodes"),
    lint.Plant("lib/mesh/planted.cpp", "t.edge_faces(o, f);\n", "planted.cpp:1: faces at edges by offsets"),
    lint.Plant("lib/mesh/planted.h", "struct P { std::vector<Triangle> t; };\n", "types with triangles of their own"),
    lint.Plant("lib/meshing/engine/planted.h", "struct PlacedPatch {\n", "addresses of patches"),
    lint.Plant("lib/meshing/engine/planted.h", "struct TilePlace {\n  FaceId face;\n", "addresses of patches"),
    lint.Plant("lib/mesh/planted.h", "class SectionNumbers {\n", "weldings"),
    lint.Plant("lib/mesh/planted.h", "std::int64_t node_key(NodeId n);\n", "keys of nodes"),
    lint.Plant("lib/mesh/planted.h", "struct P { int " + ", ".join(f"m{i}" for i in range(16)) + "; };\n",
               "classes have more than 15 members"),
    lint.Plant("lib/mesh/planted.cpp", "\n" * 401, "files are longer than 400 lines"),
]

if __name__ == "__main__":
    sys.exit(lint.main(check, PLANTS))
