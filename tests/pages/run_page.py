#!/usr/bin/env python3
"""Runs the blocks of commands (```sh) of a page, one after the other, in one new folder.

usage: run_page.py PAGE [--long] [--keep FOLDER]     --long: also the blocks that take minutes
       run_page.py --self-test                       plants failures in pages and expects to find them
environment: ST_BIN, the tools; ST_MODELS, the test models; ST_CORPUS, real CAD files

Comments before a block say what it needs; readers of the page do not see them:
  <!-- run: needs gmsh corpus -->       left out, with a loud line, where a program or the corpus is missing
  <!-- run: long -->                    left out without --long
  <!-- run: fails 4, says NO FACE -->   must end with this exit code, and print this text
  <!-- run: never, reason -->           not run
  <!-- model: wing.step = box.step -->  a file that the page only names: taken from the test models or the corpus
A block ```toml or ```text below <!-- file: NAME --> is written to that file. Of a block without a language below
<!-- run: shown --> each line must be in what was printed so far: words alike, numbers within 10 %, up to a "…".
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

SOURCE = Path(__file__).resolve().parents[2]
PIECE = re.compile(r"^<!-- (run|model|file): (.*?) -->$|^```(\w*)\n(.*?)^```$", re.M | re.S)
NUMBER = re.compile(r"-?\d[\d.]*")
SECONDS = 600  # for one block
ALIKE = 0.1    # of a number that a page shows


class Block(NamedTuple):
    line: int
    text: str
    notes: str  # what the comment says, empty: run it


def pieces(text):
    """(kind, line, content): model, file, block and shown, in their order."""
    notes, name = "", None
    for match in PIECE.finditer(text):
        kind, content, language, body = match.groups()
        line = text.count("\n", 0, match.start()) + 1
        if kind == "run":
            notes = content
        elif kind == "model":
            yield "model", line, [part.strip() for part in content.split("=")]
        elif kind == "file":
            name = content
        elif name:
            yield "file", line, (name, body)
            name = None
        elif language == "sh":
            yield "block", line, Block(line, body, notes)
            notes = ""
        elif notes == "shown":
            yield "shown", line, body
            notes = ""


def missing(notes, corpus):
    """What the block needs and is not here."""
    match = re.match(r"needs ([\w -]+)", notes)
    needed = match.group(1).split() if match else []
    return [n for n in needed if not (corpus and corpus.is_dir() if n == "corpus" else shutil.which(n))]


def find_model(name, folders):
    for folder in folders:
        if folder and (folder / name).is_file():
            return folder / name
    return None


def is_alike(shown, said):
    """Whether a line was said like one that a page shows."""
    is_whole = "…" not in shown
    numbers = [[float(n.rstrip(".")) for n in NUMBER.findall(text)] for text in (shown.partition("…")[0], said)]
    words = [" ".join(NUMBER.sub("#", text).split()) for text in (shown.partition("…")[0], said)]
    is_same = words[0] == words[1] if is_whole else words[1].startswith(words[0])
    return is_same and all(abs(a - b) <= ALIKE * abs(b) for a, b in zip(*numbers))


def unlike(shown, said):
    """The first line that is shown and was not said, or None."""
    lines = said.splitlines()
    return next((s for s in shown.splitlines() if s.strip("… ") and not any(is_alike(s, own) for own in lines)), None)


def run_block(block, folder, environment, said):
    """None, or what went wrong; what is printed goes to the end of `said`."""
    done = subprocess.run(["bash", "-eu", "-o", "pipefail", "-c", block.text], cwd=folder, env=environment, text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=SECONDS)
    said.append(done.stdout)
    expected = re.search(r"fails (\d+)", block.notes)
    wanted = int(expected.group(1)) if expected else 0
    text = re.search(r"says (.+)$", block.notes)
    if done.returncode != wanted:
        return f"exit code {done.returncode}, not {wanted}\n{block.text}{done.stdout[-3000:]}"
    if text and text.group(1) not in done.stdout:
        return f"does not say '{text.group(1)}'\n{block.text}{done.stdout[-3000:]}"
    return None


def run_page(page, folder, long=False):
    """Runs all blocks; ends at the first that fails. Returns (blocks run, left out, failure or None)."""
    corpus = Path(os.environ["ST_CORPUS"]) if os.environ.get("ST_CORPUS") else None
    models = Path(os.environ["ST_MODELS"]) if os.environ.get("ST_MODELS") else None
    environment = {**os.environ, "PATH": f"{os.environ.get('ST_BIN', '')}:{os.environ['PATH']}", "LC_ALL": "C.UTF-8"}
    for name in ("examples", "scripts"):
        (folder / name).unlink(missing_ok=True)
        (folder / name).symlink_to(SOURCE / name)
    n_run = n_left = 0
    said = []
    for kind, line, content in pieces(page.read_text(encoding="utf-8")):
        where = f"{page.name}:{line}"
        if kind == "file":
            (folder / content[0]).write_text(content[1], encoding="utf-8")
        elif kind == "shown":
            if n_left == 0 and (line_shown := unlike(content, "".join(said))):
                return n_run, n_left, f"{where}: shown, but not said: {line_shown}\n{''.join(said)[-3000:]}"
        elif kind == "model":
            source = find_model(content[1], [models, corpus])
            if source:
                (folder / content[0]).unlink(missing_ok=True)
                (folder / content[0]).symlink_to(source)
        elif "never" in content.notes or ("long" in content.notes and not long):
            print(f"{where}: left out: {content.notes}")
            n_left += 1
        elif lacking := missing(content.notes, corpus):
            print(f"SKIPPED: {where}: not here: {', '.join(lacking)}; these commands were not run:\n{content.text}")
            n_left += 1
        else:
            failure = run_block(content, folder, environment, said)
            n_run += 1
            if failure:
                return n_run, n_left, f"{where}: {failure}"
            print(f"{where}: ok", flush=True)
    return n_run, n_left, None


PLANTS = {  # a page: what its failure must contain; None: it passes
    "```sh\ntrue\nfalse\necho here\n```\n": "planted.md:1: exit code 1",
    "text\n\n```sh\nno_such_tool model.step\n```\n": "planted.md:3: exit code 127",
    "```sh\nfalse | cat\n```\n": "exit code 1",
    "<!-- run: fails 4 -->\n```sh\ntrue\n```\n": "exit code 0, not 4",
    "<!-- run: fails 4 -->\n```sh\nexit 4\n```\n": None,
    "<!-- run: says 2 faces -->\n```sh\necho 3 faces\n```\n": "does not say '2 faces'",
    "<!-- run: fails 4, says 2 faces -->\n```sh\necho 2 faces\nexit 4\n```\n": None,
    "<!-- run: never, needs root -->\n```sh\nfalse\n```\n": None,
    "<!-- run: needs no_such_program -->\n```sh\nfalse\n```\n": None,
    "<!-- run: long -->\n```sh\nfalse\n```\n": None,
    "<!-- file: a.toml -->\n```toml\nx = 1\n```\n\n```sh\ngrep -q 'x = 2' a.toml\n```\n": "exit code 1",
    "```sh\necho 3 faces, 95 edges\n```\n\n<!-- run: shown -->\n```\n  3 faces, 100 …\n…\n```\n": None,
    "```sh\necho 3 faces, 95 edges\n```\n\n<!-- run: shown -->\n```\n3 faces, 110 edges\n```\n": "not said: 3 faces",
    "```sh\necho 3 faces, 95 edges\n```\n\n<!-- run: shown -->\n```\n3 faces\n```\n": "not said: 3 faces",
    "```sh\ntouch a\n```\n\n```sh\ntest -f a\ntest -d examples/openfoam\n```\n": None,
}


def self_test():
    wrong = []
    for text, expected in PLANTS.items():
        with tempfile.TemporaryDirectory() as name:
            page = Path(name) / "planted.md"
            page.write_text(text, encoding="utf-8")
            (Path(name) / "run").mkdir()
            _, _, failure = run_page(page, Path(name) / "run")
            if (failure is None) != (expected is None) or (expected and expected not in failure):
                wrong.append(f"self test: expected {expected}, got {failure} of\n{text}")
    return wrong


def main():
    if "--self-test" in sys.argv:
        wrong = self_test()
        print("\n".join(wrong) or "all planted failures found")
        return 1 if wrong else 0
    page = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory(prefix="st_page_") as name:
        folder = Path(sys.argv[sys.argv.index("--keep") + 1]) if "--keep" in sys.argv else Path(name)
        folder.mkdir(exist_ok=True, parents=True)
        n_run, n_left, failure = run_page(page, folder, "--long" in sys.argv)
    if failure:
        print(failure, file=sys.stderr)
        return 1
    print(f"{page.name}: {n_run} blocks run, {n_left} left out")
    return 0


if __name__ == "__main__":
    sys.exit(main())
