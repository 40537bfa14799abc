#!/usr/bin/env python3
"""Ideas that the code has once: each stands in the one file that is named here, and nowhere else in lib and tools.

A new idea is a row of ONCE: what it is, how its code looks, and the file to use instead. What is to be nowhere is a row
of NEVER, with what to do instead. Files of lib that are longer than LONG lines are at most
MOST_LONG.
"""
import re
import sys

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
    ("whether a face is joined to another", r"\bloops\((?:[^()]|\([^()]*\))*\)\.empty\(\)",
     "lib/geometry/model/model.h"),
]
NEVER = [
    ("a summary's JSON parsed again", r"parse\([\w.>-]*(?:summary|association)[\w.>-]*json", "pass its values"),
    ("tasks without the names of their fields", r"\brun_named_tasks\(\s*\{\s*[^.\s]", "write {.order = ...}"),
]
LONG, MOST_LONG = 400, 11


def check(root):
    n_long = sum(len((root / path).read_text(encoding="utf-8").splitlines()) > LONG
                 for path in lint.sources(root, under=("lib",)))
    if n_long > MOST_LONG:
        yield f"lib: {n_long} files are longer than {LONG} lines, at most {MOST_LONG} may be; make one simpler"
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
    lint.Plant("lib/mesh/planted.cpp", "\n" * 401, "files are longer than 400 lines"),
]

if __name__ == "__main__":
    sys.exit(lint.main(check, PLANTS))
