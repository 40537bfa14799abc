#!/usr/bin/env python3
"""Messages of commits made after this lint was: `area: summary` of at most 72 characters, an empty line, then a body.

usage: commits.py SOURCE_DIR              exit 1 and one line per violation
       commits.py SOURCE_DIR --self-test  makes a repository with one violation of each rule and expects to find it

The body says why and what users see. Merges are passed over, and a subject that begins with Revert needs no area.
Without a history, as in an archive of the sources, there is nothing to judge.
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import house

MOST_COLUMNS = 72
AREA = re.compile(r"^(?:Revert \"|[\w./, -]+: \S)")
THIS = "tests/lint/commits.py"


def git(root, *words):
    """What git prints, or None where it fails."""
    command = ["git", "-c", f"safe.directory={root}", "-C", str(root), *words]
    done = subprocess.run(command, capture_output=True, text=True)
    return done.stdout if done.returncode == 0 else None


def messages(root):
    """(short hash, lines of the message) of each commit after the one that added this file, the oldest first."""
    added = (git(root, "log", "--diff-filter=A", "--format=%H", "--", THIS) or "").split()
    if not added:
        return []
    log = git(root, "log", "--reverse", "--no-merges", "--format=%h%n%B%x00", f"{added[-1]}..HEAD") or ""
    commits = [entry.strip("\n").split("\n") for entry in log.split("\0") if entry.strip()]
    return [(lines[0], lines[1:]) for lines in commits]


def violations(root):
    found = []
    for commit, lines in messages(root):
        subject, rest = lines[0], lines[1:]
        if len(subject) > MOST_COLUMNS:
            found.append(f"{commit}: the subject has {len(subject)} characters, at most {MOST_COLUMNS}: {subject}")
        if not AREA.match(subject):
            found.append(f"{commit}: the subject is no `area: summary`: {subject}")
        if len(rest) < 2 or rest[0] or not "".join(rest):
            found.append(f"{commit}: no body after an empty line: say why, and what users see: {subject}")
    return found


PLANTS = {  # message: what is found
    "area: summary\n\nWhy it is so.": None,
    "area: " + "x" * MOST_COLUMNS + "\n\nWhy.": "the subject has 78 characters",
    "summary without an area\n\nWhy.": "the subject is no `area: summary`",
    "area: no body": "no body",
    "area: body at once\nWhy.": "no body",
}


def self_test(root):
    missed = []
    with tempfile.TemporaryDirectory() as folder:
        repository = Path(folder)
        git(repository, "init", "-q")
        if violations(repository):
            missed.append("a repository without this lint has nothing to judge")
        path = repository / THIS
        path.parent.mkdir(parents=True)
        path.write_text("lint\n", encoding="utf-8")
        git(repository, "add", "-A")
        names = ("-c", "user.name=t", "-c", "user.email=t@t")
        git(repository, *names, "commit", "-qm", "not judged: it is the one that adds the lint")
        for message, expected in PLANTS.items():
            git(repository, *names, "commit", "-q", "--allow-empty", "--cleanup=verbatim", "-m", message)
            found = [f for f in violations(repository) if f.split(":")[0] == git(
                repository, "log", "-1", "--format=%h").strip()]
            if bool(found) != bool(expected) or not all(expected in f for f in found):
                missed.append(f"{message!r} gives {found}")
    return [f"self test: {m}" for m in missed]


if __name__ == "__main__":
    sys.exit(house.main(violations, self_test))
