#!/usr/bin/env python3
"""Plants a break in each validation of lib/io, one at a time, and says which the unit tests of io do not notice.

usage: tests/fuzz/planted_breaks.py [--work DIR] [--jobs N] [--only TEXT] [--list]

A validation is an if whose consequence throws (throw Error, fail(), damaged() ...), or that returns the text of a
defect, or a call of require_*() as a statement. Each gets a number N in a copy of the sources: the condition becomes
`(condition) && !st_planted(N)`, the call is left out when N is planted. So all breaks are in one program, and the
environment variable ST_PLANTED chooses one. What no test ever makes true is unseen without a run of its own. Those
that no test can reach stand in planted_breaks_exempt.txt, with the reason. Run by hand: takes about half an hour.
Exit 1 when a break is unseen that is not exempt, or an exemption is no longer needed.
"""
import argparse
import concurrent.futures
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
EXEMPT = Path(__file__).with_name("planted_breaks_exempt.txt")
THROWS = re.compile(r"(throw\s+Error\b|(\w+(\.|->))?(fail\w*|damaged|bad|refuse\w*|reject\w*|no_\w+)\()")
REQUIRE = re.compile(r"(?<=[;{})])\s+((\w+(\.|->))?(require_\w+|refuse_\w+|fail_unless_\w+)\()")
DEFECT_FUNCTION = re.compile(r"^ *[\w:<>&* ]+\b\w*(defect|refusal)\w*\(", re.M)
PLANTED = """#pragma once
#include <fcntl.h>
#include <unistd.h>
#include <cstdlib>
#include <string>
/// Opened before any test, for there are tests that let no file be opened.
inline const int st_planted_log =
    std::getenv("ST_PLANTED_LOG") ? open(std::getenv("ST_PLANTED_LOG"), O_WRONLY | O_APPEND | O_CREAT, 0666) : -1;
/// Whether this break is planted; says once that it was asked. Written by tests/fuzz/planted_breaks.py.
inline bool st_planted(int n) {
  static const int chosen = std::getenv("ST_PLANTED") ? std::atoi(std::getenv("ST_PLANTED")) : -1;
  static bool asked[4096];
  if (!asked[n] && st_planted_log >= 0) {
    asked[n] = true;
    const std::string line = std::to_string(n) + "\\n";
    if (write(st_planted_log, line.data(), line.size()) < 0) std::abort();
  }
  return n == chosen;
}
"""


def blanked(text):
    """The same length, with comments and the insides of strings and characters as blanks."""
    pattern = r'R"(\w*)\((?:.|\n)*?\)\1"|//[^\n]*|/\*(?:.|\n)*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\''

    def blank(match):
        found = match.group()
        if found[0] == "'" and re.match(r"\w", text[match.start() - 1 : match.start()] or " "):
            return found  # digits' separator
        inside = "".join(c if c == "\n" else " " for c in found)
        return inside if found[0] == "/" else found[0] + inside[1:-1] + found[-1]

    return re.sub(pattern, blank, text)


def closing(text, at):
    """Index of the bracket that closes the one at `at`."""
    depth = 0
    for i in range(at, len(text)):
        depth += (text[i] in "([{") - (text[i] in ")]}")
        if depth == 0:
            return i
    raise ValueError("a bracket is not closed")


class Site:
    """A validation: what to insert where, to switch it off."""

    def __init__(self, path, line, what, edits):
        self.path, self.line, self.what, self.edits = path, line, what, edits

    @property
    def key(self):
        return f"{self.path}: {self.what}"


def enclosing_is_defect(plain, at):
    """Whether the function around returns the text of a defect."""
    heads = [m for m in re.finditer(r"^(  )?[\w\[][^\n;]*\([^\n;]*\{$", plain[:at], re.M) if "if (" not in m.group()]
    return bool(heads) and bool(DEFECT_FUNCTION.match(heads[-1].group()))


def sites_of(path, text):
    plain, found = blanked(text), []
    for match in re.finditer(r"\bif (?:constexpr )?\(", plain):
        start, end = match.end() - 1, closing(plain, match.end() - 1)
        body = plain[end + 1 :].lstrip().lstrip("{").lstrip()
        throws = THROWS.match(body)
        returns = re.match(r'return [^;]*"', body) and enclosing_is_defect(plain, match.start())
        if not throws and not returns or "constexpr" in match.group():
            continue
        begin = start + 1
        for i in range(start + 1, end):  # after the last ; of an initialiser
            if plain[i] == ";" and plain[start + 1 : i].count("{") == plain[start + 1 : i].count("}"):
                begin = i + 1
        condition = " ".join(text[begin:end].split())
        if re.match(r"(const |auto )[^=]*[^=<>!]=[^=]", condition):
            continue  # a declaration is the condition
        number = text.count("\n", 0, match.start()) + 1
        found.append(Site(path, number, f"if ({condition})", [(begin, " ("), (end, ") && !st_planted(%d)")]))
    for match in REQUIRE.finditer(plain):
        end = closing(plain, match.end() - 1)
        if plain[end + 1 : end + 2] != ";":
            continue  # a definition
        begin = match.start(1)
        what = " ".join(text[begin : end + 1].split())
        number = text.count("\n", 0, begin) + 1
        found.append(Site(path, number, what, [(begin, "st_planted(%d) ? void() : ")]))
    return sorted(found, key=lambda site: site.line)


def all_sites(root):
    paths = sorted(p for p in root.glob("lib/io/**/*") if p.suffix in (".h", ".cpp"))
    return [site for p in paths for site in sites_of(str(p.relative_to(root)), p.read_text())]


def plant(source, sites):
    """Writes all breaks into the copy of the sources."""
    (source / "lib/base/planted.h").write_text(PLANTED)
    for path in {site.path for site in sites}:
        text = (source / path).read_text()
        edits = [(at, part % n if "%d" in part else part)
                 for n, site in enumerate(sites) if site.path == path for at, part in site.edits]
        for at, part in sorted(edits, reverse=True):
            text = text[:at] + part + text[at:]
        first = text.index("#include")
        (source / path).write_text(text[:first] + '#include "base/planted.h"\n' + text[first:])


def build(work, sites, jobs):
    source = work / "source"
    shutil.rmtree(source, ignore_errors=True)
    names = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, check=True).stdout.decode()
    for name in filter(None, names.split("\0")):
        (source / name).parent.mkdir(parents=True, exist_ok=True)
        if (ROOT / name).is_file():
            shutil.copy2(ROOT / name, source / name)
    plant(source, sites)
    folder = source / "build/check"  # where make check has it: a compiler cache knows what is not changed
    subprocess.run(["cmake", "-S", source, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DST_TESTS=ON",
                    "-DST_WERROR=OFF", "-DST_WHOLE_SUITES=ON"], check=True, stdout=subprocess.DEVNULL)
    env = os.environ | {"CCACHE_BASEDIR": str(source), "CCACHE_NOHASHDIR": "1"}
    subprocess.run(["ninja", "-C", folder, f"-j{jobs}", "unit_io"], check=True, stdout=subprocess.DEVNULL, env=env)
    return folder / "tests/unit_io"


def run(program, planted=None, log=None):
    """Whether all unit tests pass; those that hang or crash do not."""
    room = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
    with tempfile.TemporaryDirectory(dir=room) as folder:
        env = os.environ | {"TMPDIR": folder} | ({"ST_PLANTED": str(planted)} if planted is not None else {})
        env |= {"ST_PLANTED_LOG": str(log)} if log else {}
        limit = ["bash", "-c", 'ulimit -v 16000000; exec "$@"', "bash"]
        try:
            return subprocess.run([*limit, program, "--gtest_brief=1", "--gtest_fail_fast"], env=env, cwd=folder,
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=90).returncode == 0
        except subprocess.TimeoutExpired:
            return False


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--work", type=Path, help="folder of the build, kept; default: a new one, removed")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--only", default="", help="breaks whose file and text contain this")
    parser.add_argument("--list", action="store_true", help="the validations that are found, and nothing else")
    args = parser.parse_args()
    sites = all_sites(ROOT)
    chosen = [n for n, site in enumerate(sites) if args.only in site.key]
    if args.list:
        for n in chosen:
            print(f"{n}: {sites[n].path}:{sites[n].line}: {sites[n].what}")
        return 0
    with tempfile.TemporaryDirectory() as new:
        work = (args.work or Path(new)).resolve()
        program, log = build(work, sites, args.jobs), work / "asked.txt"
        log.unlink(missing_ok=True)
        if not run(program, log=log):
            sys.exit("planted_breaks: error: the unit tests fail without a break")
        asked = {int(line) for line in log.read_text().split()}
        exempt = [line for line in EXEMPT.read_text().splitlines() if line and line[0] not in "# "]
        with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
            unseen = list(pool.map(lambda n: n not in asked or run(program, planted=n), chosen))
    return report(sites, [n for n, missed in zip(chosen, unseen) if missed], chosen, asked, exempt)


def report(sites, unseen, chosen, asked, exempt):
    wrong = 0
    for n in unseen:
        if sites[n].key not in exempt:
            wrong += 1
            print(f"UNSEEN {sites[n].path}:{sites[n].line}: {sites[n].what}{'' if n in asked else ' [never true]'}")
    known = {sites[n].key for n in unseen}
    needless = [e for e in exempt if e in {sites[n].key for n in chosen} and e not in known]
    for entry in needless:
        print(f"NO LONGER NEEDED {entry}")
    excused = len(unseen) - wrong
    print(f"{len(chosen)} breaks, {len(chosen) - len(unseen)} seen, {excused} exempt, {wrong} unseen")
    return 1 if wrong or needless else 0


if __name__ == "__main__":
    sys.exit(main())
