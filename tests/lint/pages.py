#!/usr/bin/env python3
"""Compares what is written with the code: named pages exist; names, files and constants in docs/design are the code's.
Pages for users, all but docs/dev and docs/design, have at most MOST_LINES lines: figures, tables of runs and histories
belong in docs/dev.

usage: pages.py SOURCE_DIR              exit 1 and one line per violation
       pages.py SOURCE_DIR --self-test  plants one violation of each rule in a copy and expects to find it
"""
import re
import shutil
import sys
import tempfile
from pathlib import Path

import house

# programs whose self-tests name pages that are not there
PLANTING = {"pages.py", "english.py", "run_page.py", "site_test.sh"}
SEARCHED = ("lib", "tools", "tests", "docs", "bench", "scripts", "examples")  # and what lies beside them
PLAIN = {".h", ".cpp", ".py", ".sh", ".txt", ".md", ".workflow"}
MOST_LINES = 4200
PAGE = re.compile(r"(?<![\w*<])((?:\.{1,2}/)*(?:[\w.-]+/)*[\w-]+\.md)\b")
LINK = re.compile(r"\]\((?!https?:)([^)#\s]*)(?:#([^)\s]+))?\)")
CODE = re.compile(r"`([^`\n]+)`")
CONSTANT = re.compile(r"^(k[A-Z]\w*) = (.+)$")
CALL = re.compile(r"^(?:[\w:]+::)?(\w+)\(\)$")
NAME = re.compile(r"^(k[A-Z]\w*|[A-Z][a-z]+[A-Z]\w*)$")
SNAKE = re.compile(r"^([a-z][a-z0-9]*(?:_[a-z0-9]+)+)_?$")
FILE = re.compile(r"^(?:[\w.-]+/)*[\w-]+\.(?:h|cpp|py|sh)$")


def text_of(path):
    return path.read_text(encoding="utf-8", errors="replace")


def written(root):
    """Files in which a page may be named."""
    files = [p for p in root.iterdir() if p.is_file()]
    for folder in SEARCHED:
        files += (root / folder).rglob("*")
    return sorted(p for p in files if p.is_file() and p.suffix in PLAIN and p.name not in PLANTING)


def anchors(page):
    """The places of a page that a link may name: headings, as GitHub writes them."""
    headings = re.findall(r"^#+ (.*)$", text_of(page), re.M)
    return {re.sub(r"[^\w\- ]", "", h.lower()).strip().replace(" ", "-") for h in headings}


def page_violations(root):
    for path in written(root):
        where = path.relative_to(root)
        for match in PAGE.finditer(text_of(path)):
            bases = (path.parent, root, root / "docs", root / "docs/design")
            if not any((base / match.group(1)).is_file() for base in bases):
                yield f"{where}: names {match.group(1)}, which is not in the repository"


def link_violations(root):
    folders = (root / "docs", root / "examples")
    for page in [root / "README.md", root / "CONTRIBUTING.md", *(p for f in folders for p in f.rglob("*.md"))]:
        where = page.relative_to(root)
        for target, anchor in LINK.findall(text_of(page)):
            to = page if not target else page.parent / target
            if not to.exists():
                yield f"{where}: links to {target}, which is not there"
            elif anchor and anchor not in anchors(to):
                yield f"{where}: links to #{anchor} of {to.name}, which has no such heading"


def design_violations(root):
    """Backticked constants with values, functions, types and files of docs/design are in the code."""
    folders = ("lib", "tools", "tests", "bench", "scripts")
    files = [p for folder in folders for p in (root / folder).rglob("*") if p.is_file()]
    paths = {"/" + p.relative_to(root).as_posix() for p in files}
    code = "\n".join(text_of(p) for p in files if p.suffix in {".h", ".cpp"})
    words = set(re.findall(r"\w+", code)) | {p.stem for p in files}
    defined = {}
    for name, value in re.findall(r"\b(k[A-Z]\w*)(?:\[\w*\])? ?= ?([^;]+?)(?:, k[A-Z]\w* = [^;]+)?;", code):
        defined.setdefault(name, set()).add(" ".join(value.split()))
    for page in sorted((root / "docs/design").glob("*.md")):
        for span in CODE.findall(text_of(page)):
            where = f"{page.relative_to(root)}: `{span}`"
            if (m := CONSTANT.match(span)) and m.group(2) not in defined.get(m.group(1), set()):
                yield f"{where}: the code has {' or '.join(sorted(defined.get(m.group(1), {'no such constant'})))}"
            elif (m := CALL.match(span) or NAME.match(span) or SNAKE.match(span)) and not {m.group(1), span} & words:
                yield f"{where}: no such name in the code"
            elif FILE.match(span) and not any(p.endswith("/" + span) for p in paths):
                yield f"{where}: no such file"


def length_violations(root):
    """Pages for users are short."""
    pages = [root / "README.md", *(root / "docs").glob("*.md"), *(root / "docs/guide").glob("*.md")]
    n_lines = sum(text_of(page).count("\n") for page in pages)
    if n_lines > MOST_LINES:
        yield f"docs: pages for users have {n_lines} lines, at most {MOST_LINES}; move figures and tables to docs/dev"


def violations(root):
    return [*page_violations(root), *link_violations(root), *design_violations(root), *length_violations(root)]


PLANTS = {
    "a page that is not there": ("lib/base/planted.h", "// see NOWHERE.md\n", "names NOWHERE.md"),
    "a link to nothing": ("docs/planted.md", "[there](nothing.txt)\n", "links to nothing.txt"),
    "a link of an example": ("examples/planted.md", "[there](nothing.txt)\n", "links to nothing.txt"),
    "a link to no heading": ("docs/planted.md", "[there](meshing.md#no-such-heading)\n", "links to #no-such-heading"),
    "long pages": ("docs/planted.md", "\n" * MOST_LINES, "pages for users have"),
    "another value": ("docs/design/planted.md", "`kFinishedRadius = 0.7`\n", "the code has 0.68"),
    "a constant that is gone": ("docs/design/planted.md", "`kNoSuchThing = 0.7`\n", "no such constant"),
    "a function that is gone": ("docs/design/planted.md", "`no_such_thing()`\n", "no such name"),
    "a type that is gone": ("docs/design/planted.md", "`NoSuchThing`\n", "no such name"),
    "a test that is gone": ("docs/design/planted.md", "`no_such_test_of_this`\n", "no such name"),
    "a file that is gone": ("docs/design/planted.md", "`no_such_file.cpp`\n", "no such file"),
}


def self_test(root):
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "copy"
        copy.mkdir()
        for path in root.iterdir():
            if path.is_file():
                shutil.copy(path, copy)
            elif path.name in SEARCHED:
                shutil.copytree(path, copy / path.name, ignore=shutil.ignore_patterns("images"))
        missed = []
        for name, (file, text, expected) in PLANTS.items():
            house.plant(copy, file, text)
            if not any(f.startswith((file, "docs:")) and expected in f for f in violations(copy)):
                missed.append(name)
            (copy / file).unlink()
    return [f"self test: planted violation not found: {m}" for m in missed]


if __name__ == "__main__":
    sys.exit(house.main(violations, self_test))
