#!/usr/bin/env python3
"""Every lib/<layer>/.../x.cpp has its tests/unit/<layer>/.../x_test.cpp, or stands as <layer>/x in
exempt/untested.txt."""
import sys
from pathlib import Path

import lint


def untested(root):
    tests = lint.files(root, "_test.cpp", under=("tests/unit",))
    tests = {(Path(p).parts[2], Path(p).stem.removesuffix("_test")) for p in tests}
    found = {}
    for path in lint.files(root, ".cpp", under=("lib",)):
        layer, name = Path(path).parts[1], Path(path).stem
        if (layer, name) not in tests:
            found[f"{layer}/{name}"] = [f"{path}: no test; write tests/unit/{layer}/{name}_test.cpp"]
    return found


def check(root):
    return lint.without_exempt(root, "untested", untested(root))


def update(root):
    lint.write_exempt(root, "untested", untested(root))


PLANTS = [
    lint.Plant("lib/base/planted.cpp", "\n", "lib/base/planted.cpp: no test"),
    lint.Plant("lib/mesh/deep/planted.cpp", "\n", "lib/mesh/deep/planted.cpp: no test"),
    lint.Plant("tests/lint/exempt/untested.txt", "base/hash\n", "base/hash needs no exemption"),
    lint.Plant("tests/lint/exempt/untested.txt", "base/not_there\n", "base/not_there needs no exemption"),
]

if __name__ == "__main__":
    sys.exit(lint.main(check, PLANTS, update))
