#!/usr/bin/env python3
"""Scripts: pyflakes, shellcheck, and at most 120 columns, or the file stands in exempt/long_script_lines.txt."""
import subprocess
import sys

import lint

MAX_COLUMNS = 120


def python_files(root):
    return lint.files(root, ".py")


def shell_files(root):
    return lint.files(root, ".sh") + [".ci/run"]


def judged(root, paths, *command):
    if not paths:
        return
    done = subprocess.run([*command, *paths], cwd=root, capture_output=True, text=True, check=False)
    yield from (line for line in (done.stdout + done.stderr).splitlines() if line)


def long_lines(root):
    found = {}
    for path in python_files(root) + shell_files(root):
        for number, line in enumerate((root / path).read_text(encoding="utf-8").splitlines(), 1):
            if len(line) > MAX_COLUMNS:
                found.setdefault(path, []).append(f"{path}:{number}: {len(line)} columns, at most {MAX_COLUMNS}")
    return found


def check(root, only=""):
    """`only`: pyflakes and shellcheck judge files with this in their names."""
    shellcheck = ("shellcheck", "--external-sources", "--format=gcc")
    yield from judged(root, [p for p in python_files(root) if only in p], "pyflakes3")
    yield from judged(root, [p for p in shell_files(root) if only in p], *shellcheck)
    yield from lint.without_exempt(root, "long_script_lines", long_lines(root))


def update(root):
    lint.write_exempt(root, "long_script_lines", long_lines(root))


PLANTS = [
    lint.Plant("scripts/planted.py", "import os\n", "scripts/planted.py:1:1: 'os' imported but unused"),
    lint.Plant("scripts/planted.sh", "#!/bin/bash\nrm $1\n", "scripts/planted.sh:2:4: note: Double quote"),
    lint.Plant("scripts/planted.sh", "# " + "x" * MAX_COLUMNS + "\n", "scripts/planted.sh:1: 122 columns"),
    lint.Plant("tests/lint/exempt/long_script_lines.txt", "scripts/gone.sh\n", "scripts/gone.sh needs no exemption"),
]

if __name__ == "__main__":
    is_test = "--self-test" in sys.argv[2:]
    sys.exit(lint.main(lambda root: check(root, "planted" if is_test else ""), PLANTS, update))
