#!/usr/bin/env python3
"""How good the groups of st-import --suggest-groups are: faces in the right group, in a wrong one, in none.

Truth are the names of the faces in the file, as the bundled aircraft and its variants have them (WORDS), or --all NAME:
every wall belongs to this group, or to none with --all none.

usage: suggest_score.py BIN_DIR MODEL... [--all NAME] [--options "..."]      prints a line for each model, and a sum
"""
import argparse
import json
import re
import shlex
import subprocess
import sys
import tempfile
import tomllib
from collections import Counter
from pathlib import Path

# the beginning of a face's name, and which groups are right
WORDS = [("wing", {"wing"}), ("htail", {"tailplane"}), ("v_tail", {"v_tail"}), ("vtail", {"fin"}),
         ("flap_fairing", {"fairing"}), ("flap", {"flap"}), ("nacelle", {"nacelle"}), ("pylon", {"pylon"}),
         ("fuselage", {"fuselage"}), ("belly", {"fairing", "fuselage"}), ("symmetry", {"symmetry"}),
         ("farfield", {"farfield"})]


def faces_of(items):
    for item in items:
        first, _, last = str(item).partition("-")
        yield from range(int(first), int(last or first) + 1)


def truth_of(name, everything):
    if everything and name not in ("symmetry", "farfield"):
        return set() if everything == "none" else set(everything.split(","))
    return next((groups for word, groups in WORDS if name.startswith(word)), None)


def score(bin_dir, model, everything, options, folder):
    """Numbers of faces: right, wrong, none; and what was confused."""
    suggested, geometry = folder / "groups.toml", folder / "geometry.hdf"
    suggested.unlink(missing_ok=True)
    subprocess.run([bin_dir / "st-import", model, "-o", geometry, "--suggest-groups", suggested, *options],
                   check=True, capture_output=True)
    told = json.loads(subprocess.run([bin_dir / "st-info", geometry, "--groups", "--json"], check=True,
                                     capture_output=True, text=True).stdout.splitlines()[-1])
    names = {f: name for name, faces in told["face_names"].items() for f in faces}
    all_faces = {f for group in told["tables"][0]["groups"] for f in group["faces"]}
    group_of = {f: g["name"] for g in tomllib.loads(suggested.read_text()).get("group", [])
                for f in faces_of(g["faces"])}
    count, confused = Counter(), Counter()
    for f in sorted(all_faces):
        truth = truth_of(names.get(f, ""), everything)
        if truth is None:
            continue
        own = group_of.get(f)
        kind = "right" if own in truth or (own is None and not truth) else "none" if own is None else "wrong"
        count[kind] += 1
        if kind != "right":
            confused[f"{names.get(f) or '/'.join(sorted(truth)) or 'nothing'} as {own or 'nothing'}"] += 1
    return count, confused


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bin_dir", type=Path)
    parser.add_argument("models", nargs="+", type=Path)
    parser.add_argument("--all", default="")
    parser.add_argument("--options", default="")
    o = parser.parse_args()
    total = Counter()
    print("| model | right | wrong | none | confused |\n|---|--:|--:|--:|---|")
    with tempfile.TemporaryDirectory() as folder:
        for model in o.models:
            count, confused = score(o.bin_dir, model, o.all, shlex.split(o.options), Path(folder))
            total += count
            most = ", ".join(f"{n} {what}" for what, n in confused.most_common(4))
            print(f"| `{re.sub(r'[.][a-z]+$', '', model.name)}` | {count['right']} | {count['wrong']} |"
                  f" {count['none']} | {most} |", flush=True)
    print(f"| all | {total['right']} | {total['wrong']} | {total['none']} | |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
