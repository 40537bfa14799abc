"""Triangles, quality and time of each step of the moving source; exits with 5 when they drift.

usage: summary.py RESULTS STEPS
"""
import json
import sys
from pathlib import Path

MAX_DRIFT, MAX_CHANGE = 0.01, 0.05


def last_line(path):
    return json.loads(path.read_text().strip().split("\n")[-1]) if path.exists() else {}


def facts(results, step):
    check, remesh = last_line(results / f"check_{step}.json"), last_line(results / f"remesh_{step}.json")
    sizes = check.get("sizes", {}).get("free", {}).get("share", float("nan"))
    redone, seconds = remesh.get("triangles_redone", 0), remesh.get("seconds", 0)
    return check["triangles"], check["quality"]["mean"], check["quality"]["p1"], sizes, redone, seconds


def main(results, n_steps):
    names = ["00"] + [f"{i:02}" for i in range(1, n_steps + 1)] + ["restored"]
    rows = {name: facts(results, name) for name in names}
    print("step      triangles    redone  mean quality  1st percentile  good lengths  seconds")
    for name, (triangles, mean, low, sizes, redone, seconds) in rows.items():
        print(f"{name:9} {triangles:9}  {redone:8}  {mean:12.4f}  {low:14.4f}  {100 * sizes:10.2f} %  {seconds:7.2f}")
    first, last, restored = rows["01"], rows[names[-2]], rows["restored"]
    drift = max(abs(last[k] - first[k]) for k in (1, 2))
    change = abs(restored[0] / rows["00"][0] - 1)
    print(f"drift of quality {drift:.4f}; {100 * change:.2f} % triangles more or fewer once the source is gone")
    return 0 if drift <= MAX_DRIFT and change <= MAX_CHANGE else 5


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), int(sys.argv[2])))
