#!/usr/bin/env python3
"""The whole chain on all CAD models of the corpus, judged by st-check and by the independent judge beside the corpus:
one table.

usage: scripts/corpus_table.py BIN_DIR [--sizes defaults|peers|coarse|fine] [--folder DIR] [--models GLOB] [--work DIR]
       [--format md|tsv|verdicts] [--from-results]

BIN_DIR holds the tools. The corpus is ST_CORPUS (default ../shared/corpus beside the repository); --folder is another
folder of CAD files, such as ../shared/hard. One rank, one model at a time; per model at most --time-limit seconds and
--memory-limit GB of address space. Seconds in the table are processor time. Verdicts: one line per model, what both
judges say, open and non-manifold edges of the CAD allowed; what is said to cross itself in the CAD is named so. What
was measured is kept in --work as one JSON file per model; --from-results prints the table from these without running
anything. Exit 0 when every model was run to its check, whatever the check says, else 5.
"""
import argparse
import fnmatch
import json
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
CORPUS = Path(os.environ.get("ST_CORPUS") or ROOT / "../shared/corpus").resolve()
JUDGE = CORPUS.parent / "tools" / "meshcheck.sh"
CAD_SUFFIXES = {".step", ".stp", ".iges", ".igs", ".brep"}
SIZES = {
    "defaults": [],
    "peers": ["--lmax", "2.5%", "--lmin", "0.0390625%", "--alpha", "10"],  # those of PEERS.tsv
    "coarse": ["--lmax", "10%", "--lmin", "0.5%", "--alpha", "20"],
    "fine": ["--lmax", "1%", "--lmin", "0.02%"],
}
STAGES = ["import", "raster", "prolong", "mesh", "merge", "check"]
CROSSES_IN_CAD = ("face crosses itself", "faces cross", "face shrinks to a point")
OK, INCOMPLETE = 0, 5


class Stopped(Exception):
    """A stage that did not finish."""


def processor_seconds():
    """Of all processes that have ended: what other work on the machine disturbs least."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


class Chain:
    """The stages of one model, within its limits."""

    def __init__(self, bin_dir, folder, time_limit, memory_limit):
        self.bin, self.folder = Path(bin_dir), Path(folder)
        self.end = time.monotonic() + time_limit
        self.memory = int(memory_limit * 1e9)
        self.seconds = {}

    def path(self, name):
        return str(self.folder / f"{name}.hdf")

    def stage(self, name, *arguments, accept=(OK,)):
        """Runs st-<name>; its JSON summary."""
        code, out, err, self.seconds[name] = self.run([str(self.bin / f"st-{name}"), *arguments, "--json"])
        if code not in accept:
            raise Stopped(f"st-{name}: exit {code}: {err.strip().splitlines()[-1] if err.strip() else ''}")
        return json.loads(out.rstrip().splitlines()[-1])

    def run(self, command):
        limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (self.memory, self.memory))  # noqa: E731
        before = processor_seconds()
        left = self.end - time.monotonic()
        if left <= 0:
            raise Stopped(f"{Path(command[0]).name}: no time left")
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=left, preexec_fn=limit,
                                  stdin=subprocess.DEVNULL)
        except subprocess.TimeoutExpired:
            raise Stopped(f"{Path(command[0]).name}: time limit") from None
        return done.returncode, done.stdout, done.stderr, processor_seconds() - before


def run_model(model, arguments, folder):
    """What was measured on one model; "stopped" says why it did not come to its end."""
    chain = Chain(arguments.bin_dir, folder, arguments.time_limit, arguments.memory_limit)
    result = {"model": model.name, "seconds": chain.seconds}
    path = chain.path
    try:
        result["import"] = chain.stage("import", str(model), "-o", path("geometry"))
        result["raster"] = chain.stage("raster", path("geometry"), "-o", path("raster"),
                                       *SIZES[arguments.sizes])
        chain.stage("prolong", path("raster"), "-o", path("sizing"))
        result["mesh"] = chain.stage("mesh", path("geometry"), path("sizing"), "-o", path("patches"),
                                     accept=(OK, INCOMPLETE))
        result["merge"] = chain.stage("merge", path("patches"), "-o", path("mesh"), "--allow-incomplete",
                                      accept=(OK, INCOMPLETE))
        result["check"] = chain.stage(
            "check", path("mesh"), "--geometry", path("geometry"), "--sizing", path("sizing"), accept=(OK, INCOMPLETE))
        if JUDGE.exists():
            chain.end += arguments.time_limit  # the judge's time is not the chain's
            code, out, _, _ = chain.run([str(JUDGE), path("mesh"), "--cad", str(model)])
            result["judge"] = json.loads(out.splitlines()[-1]) if code in (0, 1) and out else None
    except Stopped as stop:
        result["stopped"] = str(stop)
    return result


def read_peers():
    """Gmsh's row by file name."""
    peers = CORPUS / "PEERS.tsv"
    if not peers.exists():
        return {}
    lines = [line.rstrip("\n").split("\t") for line in peers.read_text().splitlines() if not line.startswith("#")]
    return {line[0]: dict(zip(lines[0], line)) for line in lines[1:]}


COLUMNS = ["model", "triangles"] + [f"{s} s" for s in STAGES] + [
    "not meshed", "open (CAD)", "non-manifold (CAD)", "folds", "crossings", "judge: open/nm/folds/crossings",
    "min angle", "below 10°", "forced", "free", "growth free",
    "q mean",
    "q 1 %", "jump 99.9 %", "sizes %", "inner %", "area error %", "gmsh: triangles", "gmsh s", "gmsh: below 10°",
    "gmsh: q mean",
    "gmsh: jump 99.9 %", "worse than gmsh"]


def largest_area_error(check):
    """Of all faces, per cent of the CAD's area."""
    errors = [f["area_error"] for f in check["faces"] if f.get("area_error") is not None]
    return f"{100 * max(errors):.3g}" if errors else ""


def cells_of_check(check, judge):
    crossings = check["crossings"] + check["checks"]["overlaps"]["count"]
    sizes = check.get("sizes", {})
    judged = "/".join(str(judge[k]) for k in ("boundary_edges", "nonmanifold_edges", "folds",
                                              "self_intersections")) if judge else ""
    quality, causes = check["quality"], check.get("causes")
    return {
        "triangles": check["triangles"],
        "not meshed": check["checks"]["faces"]["count"],
        "open (CAD)": f"{check['boundary_edges']} ({check['cad_boundary_edges']})",
        "non-manifold (CAD)": f"{check['nonmanifold_edges']} ({check['cad_nonmanifold_edges']})",
        "folds": check["folds"],
        "crossings": crossings,
        "judge: open/nm/folds/crossings": judged,
        "min angle": f"{quality['min_angle_deg']:.2f}",
        "below 10°": quality.get("below_10_deg", judge["below_10deg"] if judge else ""),
        "forced": causes["sharp"]["count"] - causes["sharp"]["free"] if causes else "",
        "free": causes["sharp"]["free"] if causes else "",
        "growth free": f"{causes['growth']['free']} of {causes['growth']['count']}" if causes else "",
        "q mean": f"{quality['mean']:.4f}",
        "q 1 %": f"{quality['p1']:.3f}",
        "jump 99.9 %": f"{check['jump_p999']:.2f}",
        "sizes %": f"{100 * sizes['free']['share']:.1f}" if sizes else "",
        "inner %": f"{100 * sizes['inner']['share']:.1f}" if sizes else "",
        "area error %": largest_area_error(check),
    }


def worse_than(peer, judge):
    """What the judge finds worse than in Gmsh's mesh, angles and neighbours only where more than rounding."""
    bounds = {"q mean": judge["mean_q"] >= float(peer["mean_q"]) - 1e-4,
              "jump": judge["jump_p999"] <= float(peer["jump_p999"]) + 1e-3,
              "below 10°": judge["below_10deg"] <= int(peer["below_10deg"]),
              "min angle": judge["min_angle"] >= float(peer["min_angle"]) - 0.01}
    return ", ".join(name for name, holds in bounds.items() if not holds)


def cells_of(result, peer):
    """One row of the table, by column."""
    cells = {"model": result["model"]} | {f"{s} s": f"{t:.2f}" for s, t in result["seconds"].items()}
    if result.get("check"):
        cells |= cells_of_check(result["check"], result.get("judge"))
    if result.get("stopped"):
        cells["triangles"] = result["stopped"]
    if peer:
        cells |= {"gmsh: triangles": peer.get("triangles", ""), "gmsh s": peer.get("wall_s", ""),
                  "gmsh: below 10°": peer.get("below_10deg", ""),
                  "gmsh: q mean": peer.get("mean_q", ""), "gmsh: jump 99.9 %": peer.get("jump_p999", "")}
        if result.get("judge") and peer.get("min_angle"):
            cells["worse than gmsh"] = worse_than(peer, result["judge"])
    return cells


CAUSES = ["corner", "short edge", "strip", "size jump", "free"]


def place_text(place):
    what = "".join(f", {kind} {place[kind]}" for kind in ("edge", "vertex") if kind in place)
    return f"{place['value']:.3g} at ({', '.join(f'{x:.6g}' for x in place['xyz'])}) face {place['face']}{what}"


def print_causes(results):
    """What forces the sharp triangles of each model that has any, with the worst place of each cause."""
    print("\nTriangles below 10° by cause; the worst place of each cause, angle in degrees\n")
    print("| model | " + " | ".join(CAUSES) + " | worst |")
    print("|---|" + "--:|" * len(CAUSES) + "---|")
    for r in results:
        sharp = ((r.get("check") or {}).get("causes") or {}).get("sharp")
        if not sharp or not sharp["count"]:
            continue
        worst = {}
        for place in sharp["worst"]:
            worst.setdefault(place["cause"], place)
        places = "; ".join(f"{cause} {place_text(worst[cause])}" for cause in CAUSES if cause in worst)
        print(f"| {r['model']} | " + " | ".join(str(sharp["by_cause"][c]) for c in CAUSES) + f" | {places} |")


def print_free(results, n_places=10):
    """The worst places of the corpus that no cause in the CAD excuses: sharp triangles, then growth."""
    for kind, what, sign in (("sharp", "Triangles below 10° that nothing forces", 1),
                             ("growth", "Growth above 1.6 that nothing forces", -1)):
        lists = [(r["model"], r["check"]["causes"][kind]) for r in results if (r.get("check") or {}).get("causes")]
        places = [(sign * w["value"], model, w) for model, found in lists for w in found["worst"]
                  if w["cause"] == "free"]
        print(f"\n{what}: {sum(found['free'] for _, found in lists)}, the worst\n")
        for _, model, w in sorted(places, key=lambda p: (p[0], p[1]))[:n_places]:
            print(f"- {model}: {place_text(w)}")


def print_table(results, layout):
    peers = read_peers()
    rows = [[str(cells_of(r, peers.get(r["model"])).get(c, "")) for c in COLUMNS] for r in results]
    if layout == "tsv":
        print("\n".join("\t".join(row) for row in [COLUMNS, *rows]))
        return
    print("| " + " | ".join(COLUMNS) + " |")
    print("|---" + "|--:" * (len(COLUMNS) - 1) + "|")
    for row in rows:
        print("| " + " | ".join(cell.replace("|", "/") for cell in row) + " |")


def judges(result):
    """What st-check and the independent judge find, as lists of words; open edges of the CAD are no defect."""
    check, judge = result.get("check"), result.get("judge")
    if not check:
        return [result.get("stopped", "not checked")], []
    found = [f"{name} {check['checks'][name]['count']}" for name in check["failed"]]
    if not judge:
        return found, ["not judged"]
    n_shared = check["cad_nonmanifold_edges"]  # two of the four triangles there run along the edge as the others do
    allowed = {"boundary_edges": check["cad_boundary_edges"], "nonmanifold_edges": n_shared,
               "misoriented_edges": 2 * n_shared}
    kinds = ("boundary_edges", "nonmanifold_edges", "misoriented_edges", "degenerate", "duplicate_nodes", "folds",
             "self_intersections")
    return found, [f"{kind} {judge[kind]}" for kind in kinds if judge[kind] > allowed.get(kind, 0)]


def crosses_in_cad(result):
    """Whether st-import said that the CAD crosses itself."""
    return any(f["what"].startswith(CROSSES_IN_CAD) for f in (result.get("import") or {}).get("findings", []))


def print_verdicts(results):
    n_passed = n_said = 0
    for r in results:
        found, judged = judges(r)
        n_passed += not found and not judged
        n_said += bool(found or judged) and crosses_in_cad(r)
        note = "; st-import says that the CAD crosses itself" if crosses_in_cad(r) else ""
        print(f"{r['model']}: st-check {', '.join(found) or 'passes'}; judge {', '.join(judged) or 'passes'}{note}")
    print(f"{n_passed} of {len(results)} pass both, {n_said} more are said to cross themselves in the CAD")


def run_all(models, arguments, work):
    for model in models:
        with tempfile.TemporaryDirectory(dir=work) as folder:
            result = run_model(model, arguments, folder)
            if arguments.keep:
                shutil.copytree(folder, work / model.name, dirs_exist_ok=True)
        (work / f"{model.name}.json").write_text(json.dumps(result))
        check = result.get("check") or {}
        print(f"{model.name}: {result.get('stopped') or check.get('failed')}", file=sys.stderr, flush=True)


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin_dir")
    parser.add_argument("--sizes", choices=list(SIZES), default="defaults", help="peers: those of PEERS.tsv")
    parser.add_argument("--folder", type=Path, default=CORPUS, help="of the CAD files")
    parser.add_argument("--models", default="*", help="glob of file names")
    parser.add_argument("--work", default="build/corpus", help="folder for results")
    parser.add_argument("--keep", action="store_true", help="keep the artifacts there, too")
    parser.add_argument("--format", choices=["md", "tsv", "verdicts"], default="md")
    parser.add_argument("--from-results", action="store_true")
    parser.add_argument("--time-limit", type=float, default=200, metavar="SECONDS", help="per model")
    parser.add_argument("--memory-limit", type=float, default=12, metavar="GB", help="address space per process")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    if not arguments.folder.is_dir():
        sys.exit(f"no folder {arguments.folder}; set ST_CORPUS")
    models = [m for m in sorted(arguments.folder.iterdir()) if m.suffix.lower() in CAD_SUFFIXES
              and fnmatch.fnmatch(m.name, arguments.models)]
    work = Path(arguments.work)
    work.mkdir(parents=True, exist_ok=True)
    if not arguments.from_results:
        run_all(models, arguments, work)
    results = [json.loads(p.read_text()) for m in models if (p := work / f"{m.name}.json").exists()]
    if arguments.format == "verdicts":
        print_verdicts(results)
    else:
        print_table(results, arguments.format)
    if arguments.format == "md":
        print_causes(results)
        print_free(results)
    return OK if len(results) == len(models) and not any("stopped" in r for r in results) else INCOMPLETE


if __name__ == "__main__":
    sys.exit(main())
