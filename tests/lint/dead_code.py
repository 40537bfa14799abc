#!/usr/bin/env python3
"""Functions declared in headers of lib that no tool reaches: only tests and benchmarks call them, or nobody does.

By name, from the main functions of the tools: a function is reached when its name stands in the body of a reached
function, or outside of all bodies other than in a declaration (a table of functions, the start value of a member).
Functions of one name count as one, so a dead one may hide behind a live one; a name reported is dead.
Exempt names: exempt/dead_code.txt.
"""
import re
import sys
from collections import defaultdict

import lint

WORD = re.compile(r"[A-Za-z_]\w*")
ROOTS = {"main", "st_read_cad_file", "ProcessShape"}  # of modules that are loaded; called by OpenCASCADE


class Calls:
    """Which names stand where, of lib and tools."""

    def __init__(self, root):
        paths = lint.sources(root, under=("lib", "tools"))
        self.declared = {}  # name -> place, of functions that a header of lib declares
        self.words_of = defaultdict(set)  # name of a function -> names in its bodies
        self.free_words = set()  # names outside of all bodies
        functions = defaultdict(list)
        for f in lint.functions(root, paths):
            functions[f.path].append(f)
        for path in paths:
            self._read(root, path, functions[path])

    def _read(self, root, path, functions):
        lines = lint.without_comments((root / path).read_text(encoding="utf-8")).splitlines()
        lines = ["" if line.lstrip().startswith("#include") else line for line in lines]
        owner = [None] * (len(lines) + 2)  # innermost named function of each line
        named = [f for f in functions if not f.is_lambda and not f.name.startswith(("operator", "~"))]
        for f in sorted(named, key=lambda f: (f.line, -f.end)):
            if path.startswith("lib/") and path.endswith(".h"):
                self.declared.setdefault(f.name, f"{path}:{f.line}")
            owner[f.line:f.end + 1] = [f.name] * (f.end + 1 - f.line)
        for number, line in enumerate(lines, 1):
            words = set(WORD.findall(line))
            if owner[number] is None:
                self.free_words |= words
            else:
                self.words_of[owner[number]] |= words - {owner[number]}

    def reached(self):
        found, new = set(), ROOTS | self.free_words
        while new:
            found |= new
            new = {word for name in new for word in self.words_of.get(name, ())} - found
        return found


def dead(root):
    calls = Calls(root)
    names = sorted(calls.declared.keys() - calls.reached())
    return {name: [f"{calls.declared[name]}: no tool reaches {name}(); remove it"] for name in names}


def check(root):
    return lint.without_exempt(root, "dead_code", dead(root))


def update(root):
    lint.write_exempt(root, "dead_code", dead(root))


HEADER = "int planted_one(int);\nint planted_two(int);\n"
CALL = "inline int planted_one(int i) {\n  return planted_two(i);\n}\n"
PLANTS = [
    lint.Plant("lib/base/planted.h", HEADER, "no tool reaches planted_one"),
    # one that only another dead one calls
    lint.Plant("lib/base/planted.h", HEADER + CALL, "no tool reaches planted_two"),
    lint.Plant("tests/lint/exempt/dead_code.txt", "find\n", "find needs no exemption"),
]

if __name__ == "__main__":
    sys.exit(lint.main(check, PLANTS, update))
