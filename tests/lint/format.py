#!/usr/bin/env python3
"""C++ sources are as clang-format makes them and have at most 120 columns; scripts/format.sh formats them."""
import re
import subprocess
import sys

import lint

MAX_COLUMNS = 120


def unformatted(root, paths):
    done = subprocess.run(["clang-format", "--dry-run", *paths], cwd=root, capture_output=True, text=True, check=True)
    return sorted(set(re.findall(r"^(\S+?):\d+:\d+: warning: .*clang-format", done.stderr, re.M)))


def check(root, paths=None):
    paths = paths or lint.sources(root)
    for path in unformatted(root, paths):
        yield f"{path}: not formatted; run scripts/format.sh"
    for path in paths:
        for number, line in enumerate((root / path).read_text(encoding="utf-8").splitlines(), 1):
            if len(line) > MAX_COLUMNS:
                yield f"{path}:{number}: {len(line)} columns, at most {MAX_COLUMNS}"


PLANTS = [
    lint.Plant("lib/base/planted.h", "int  planted( );\n", "lib/base/planted.h: not formatted"),
    lint.Plant("lib/base/planted.h", "// " + "-" * MAX_COLUMNS + "\n", "lib/base/planted.h:1: 123 columns"),
]

if __name__ == "__main__":
    is_test = "--self-test" in sys.argv[2:]
    sys.exit(lint.main(lambda root: check(root, ["lib/base/planted.h"] if is_test else None), PLANTS))
