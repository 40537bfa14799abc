#!/usr/bin/env python3
"""No function has more than 60 lines, or its name stands in exempt/long_functions.txt.

Also prints how long functions are: 30 lines are meant to be the most.
"""
import statistics
import sys
from pathlib import Path

import lint

LIMIT = 60
LONG = 30


def lengths(root):
    """(number of lines, function) of all functions with a body, longest first."""
    bodies = [f for f in lint.functions(root, lint.sources(root)) if f.is_definition and not f.is_lambda]
    return sorted(((f.end - f.line + 1, f) for f in bodies), reverse=True)


def too_long(root):
    found = {}
    for n, f in lengths(root):
        if n > LIMIT:
            found.setdefault(f.name, []).append(f"{f.path}:{f.line}: {f.name} has {n} lines; at most {LIMIT}")
    return found


def check(root):
    return lint.without_exempt(root, "long_functions", too_long(root))


def update(root):
    lint.write_exempt(root, "long_functions", too_long(root))


PLANTS = [
    lint.Plant("lib/base/planted.cpp", "void planted() {\n" + "  f();\n" * (LIMIT - 1) + "}\n", "planted has 61 lines"),
    lint.Plant("tests/lint/exempt/long_functions.txt", "planted\n", "planted needs no exemption"),
]

if __name__ == "__main__":
    of_lib = [n for n, f in lengths(Path(sys.argv[1]).resolve()) if f.path.startswith("lib/")]
    share = 100 * sum(n > LONG for n in of_lib) / len(of_lib)
    print(f"lib: {len(of_lib)} functions, median {statistics.median(of_lib):.0f} lines, {share:.1f} % over {LONG}, "
          f"longest {of_lib[0]}")
    sys.exit(lint.main(check, PLANTS, update))
