#!/usr/bin/env python3
"""Plain English: sentences of at most 30 words in documentation and --help, lines of at most 120 columns.

Files with longer sentences stand in exempt/long_sentences.txt, those with longer lines in exempt/long_lines.txt.

usage: english.py SOURCE_DIR [--self-test | --update | --count | --help-of BIN_DIR]
"""
import re
import subprocess
import sys
from pathlib import Path

import lint

MAX_WORDS = 30
MAX_COLUMNS = 120
# Not the end of a sentence.
ABBREVIATIONS = re.compile(r"\b(e\.g|i\.e|etc|cf|vs|al|Fig|No|approx)\.(?=\s)")
LONG_LINK = re.compile(r"\]\(\S{60,}\)|https?://\S{60,}")
ITEM = re.compile(r"^\s*([-*+]|\d+[.)])\s+")


def pages(root):
    return [p for p in lint.files(root, ".md") if not p.startswith("tests/")]


def paragraphs(text):
    """(line number, text) of paragraphs and list items; code blocks, tables, headings and pictures apart."""
    start, lines, in_code = 0, [], False
    for number, line in enumerate(text.splitlines(), 1):
        is_fence = line.lstrip().startswith("```")
        ends = is_fence or in_code or not line.strip() or line.lstrip().startswith(("|", "#", "!["))
        if is_fence:
            in_code = not in_code
        if lines and (ends or ITEM.match(line)):
            yield start, " ".join(lines)
            lines = []
        if not ends:
            start = start if lines else number
            lines.append(ITEM.sub("", line).strip())
    if lines:
        yield start, " ".join(lines)


def sentences(text):
    """Sentences of a paragraph; code and links count as what one reads."""
    text = re.sub(r"`[^`]*`", "CODE", text)
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text)
    text = ABBREVIATIONS.sub(r"\1", text)
    return re.split(r"(?<=[.!?])[\"')*_]*\s+(?=[\"'(*_]*[A-Z0-9])", text)


def n_words(sentence):
    return sum(bool(re.search(r"\w", word)) for word in sentence.split())


def long_in(where, start, text):
    for sentence in sentences(text):
        n = n_words(sentence)
        if n > MAX_WORDS:
            yield f"{where}:{start}: {n} words, at most {MAX_WORDS}: {sentence[:70]}..."


def long_sentences(root):
    found = {}
    for page in pages(root):
        for start, text in paragraphs((root / page).read_text(encoding="utf-8")):
            for violation in long_in(page, start, text):
                found.setdefault(page, []).append(violation)
    return found


def long_lines(root):
    """Tables and lines that are a link or a picture may be longer, and so may code."""
    found = {}
    for page in pages(root):
        in_code = False
        for number, line in enumerate((root / page).read_text(encoding="utf-8").splitlines(), 1):
            if line.lstrip().startswith("```"):
                in_code = not in_code
            is_free = in_code or line.lstrip().startswith(("|", "![")) or LONG_LINK.search(line)
            if len(line) > MAX_COLUMNS and not is_free:
                found.setdefault(page, []).append(f"{page}:{number}: {len(line)} columns, at most {MAX_COLUMNS}")
    return found


def check(root):
    yield from lint.without_exempt(root, "long_sentences", long_sentences(root))
    yield from lint.without_exempt(root, "long_lines", long_lines(root))


def update(root):
    lint.write_exempt(root, "long_sentences", long_sentences(root))
    lint.write_exempt(root, "long_lines", long_lines(root))


def help_paragraphs(text):
    """The texts of a --help-all: what it says of each option or argument, and its free lines."""
    entry = None
    for line in text.splitlines():
        named = re.match(r"^  (-|\S)[^ ].*?(?:  +(.*))?$", line)
        if line.startswith("   ") and entry is not None:
            entry.append(line.strip())
            continue
        if entry:
            yield " ".join(entry)
        entry = [(named.group(2) or "") if named else line.strip()]
    if entry:
        yield " ".join(entry)


def long_help(folder):
    for tool in sorted(Path(folder).glob("st-*")):
        text = subprocess.run([tool, "--help-all"], capture_output=True, text=True, check=True).stdout
        for paragraph in help_paragraphs(text):
            yield from long_in(f"{tool.name} --help-all", 0, paragraph)


LONG = " ".join(["word"] * (MAX_WORDS + 1)) + ".\n"
PLANTS = [
    lint.Plant("docs/planted.md", "# Title\n\nShort. But " + LONG, "docs/planted.md:3: 32 words"),
    lint.Plant("docs/planted.md", "- Short.\n- This " + LONG, "docs/planted.md:2: 32 words"),
    lint.Plant("docs/planted.md", "x" * (MAX_COLUMNS + 1) + "\n", "docs/planted.md:1: 121 columns"),
    lint.Plant("tests/lint/exempt/long_sentences.txt", "docs/not_there.md\n", "docs/not_there.md needs no exemption"),
    lint.Plant("tests/lint/exempt/long_lines.txt", "docs/not_there.md\n", "docs/not_there.md needs no exemption"),
]


def help_self_test():
    """A --help with one long sentence, about an option whose text goes on in the next line."""
    text = "Says little.\nOptions:\n  -h,--help     print this help\n  --long NUMBER:[0, 1]=5\n" + " " * 16 + LONG
    n = sum(len(list(long_in("planted", 0, paragraph))) for paragraph in help_paragraphs(text))
    return [] if n == 1 else [f"self test: {n} long sentences found in a --help that has one"]


def main():
    if "--count" in sys.argv[2:]:
        root = Path(sys.argv[1])
        for title, found in (("sentences", long_sentences(root)), ("lines", long_lines(root))):
            print(f"long {title}: {sum(map(len, found.values()))} in {len(found)} files")
        return 0
    if "--help-of" in sys.argv[2:]:
        found = help_self_test() + list(long_help(sys.argv[sys.argv.index("--help-of") + 1]))
        print("\n".join(found) or "no violation")
        return 1 if found else 0
    return lint.main(check, PLANTS, update)


if __name__ == "__main__":
    sys.exit(main())
