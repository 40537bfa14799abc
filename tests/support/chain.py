"""What the tests of the tools share: run a tool, make artifacts of a model once, look at what is left.

Environment: ST_BIN (folder of the tools), ST_MODELS (folder of make_models), ST_WORK (folder for artifacts),
ST_CORPUS (real CAD files, by default ../shared/corpus beside the repository).
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

BIN = Path(os.environ["ST_BIN"])
MODELS = Path(os.environ["ST_MODELS"])
WORK = Path(os.environ["ST_WORK"])
CORPUS = Path(os.environ.get("ST_CORPUS") or Path(__file__).resolve().parents[2] / "../shared/corpus").resolve()
TOOLS = ["st-import", "st-edit", "st-raster", "st-prolong", "st-mesh", "st-remesh", "st-merge", "st-check", "st-info",
         "st-diff", "st-export", "st-metric", "st-run"]
PARALLEL = {"st-raster", "st-mesh", "st-remesh", "st-run"}
OK, USAGE, INPUT, GEOMETRY, INCOMPLETE, OUTPUT, MISMATCH, MEMORY, INTERNAL = 0, 2, 3, 4, 5, 6, 7, 8, 70


class Run:
    """A finished run of a tool: .code, .out, .err."""

    def __init__(self, tool, *arguments, cwd=None, timeout=300):
        self.command = [str(BIN / tool), *map(str, arguments)]
        done = subprocess.run(self.command, cwd=cwd, capture_output=True, text=True, timeout=timeout,
                              stdin=subprocess.DEVNULL)
        self.code, self.out, self.err = done.returncode, done.stdout, done.stderr

    def json(self):
        """The last line of stdout as an object."""
        return json.loads(self.out.rstrip("\n").split("\n")[-1])

    def __str__(self):
        return f"{' '.join(self.command)}\n  exit {self.code}\n  stdout: {self.out}\n  stderr: {self.err}"


def must(tool, *arguments, **keywords):
    """Runs a tool that has to succeed."""
    run = Run(tool, *arguments, **keywords)
    if run.code != OK:
        raise AssertionError(str(run))
    return run


def make_chain(model, folder, n_ranks=1, import_options=(), raster_options=(), prolong_options=(), mesh_options=()):
    """All artifacts of a CAD file in `folder`, named as the tools name them."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    ranks = ["--np", n_ranks] if n_ranks > 1 else []
    must("st-import", model, "-o", folder / "geometry.hdf", *import_options)
    must("st-raster", folder / "geometry.hdf", "-o", folder / "raster.hdf", *raster_options, *ranks)
    must("st-prolong", folder / "raster.hdf", "-o", folder / "sizing.hdf", *prolong_options)
    must("st-mesh", folder / "geometry.hdf", folder / "sizing.hdf", "-o", folder / "patches.hdf", *mesh_options, *ranks,
         timeout=1200)
    must("st-merge", folder / "patches.hdf", "-o", folder / "mesh.hdf")
    return folder


def artifacts_of(name):
    """The chain of a test model, made once for all tests; "box.step" asks for one of several formats."""
    folder = WORK / "artifacts" / name
    if not (folder / "done").exists():
        model = min(MODELS.glob(name if "." in name else name + ".*"))  # BREP first, which has no names and no unit
        with tempfile.TemporaryDirectory(dir=WORK) as fresh:
            make_chain(model, Path(fresh) / name)
            (Path(fresh) / name / "done").touch()
            folder.parent.mkdir(parents=True, exist_ok=True)
            try:
                os.rename(Path(fresh) / name, folder)
            except OSError:  # another test was quicker
                pass
    return folder


def content_hash(artifact):
    return must("st-info", artifact, "--hash").out.strip()


class ToolTest(unittest.TestCase):
    """A test case in a folder of its own."""

    def setUp(self):
        WORK.mkdir(parents=True, exist_ok=True)
        self.folder = Path(tempfile.mkdtemp(dir=WORK))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def expect_error(self, code, tool, *arguments, says=(), n_lines=1, **keywords):
        """The run ends with `code` and one line on stderr that holds every text of `says`."""
        run = Run(tool, *arguments, **keywords)
        self.assertEqual(run.code, code, run)
        lines = run.err.rstrip("\n").split("\n")
        self.assertEqual(len(lines), n_lines, run)
        self.assertTrue(lines[-1].startswith(f"{tool}: error: "), run)
        for text in [says] if isinstance(says, str) else says:
            self.assertIn(text, run.err, run)
        return run

    def expect_nothing_left(self, folder, *expected):
        """`folder` holds exactly the expected names, and the record of what ST wrote: no output, no temporary."""
        names = {p.name for p in Path(folder).iterdir()} - {".st-written"}
        self.assertEqual(sorted(names), sorted(expected))


def main_on_corpus(case, checks):
    """Runs a test case with one test more for each of `checks`: what its check() takes, the name of a file first."""
    if not CORPUS.is_dir():
        print(f"SKIPPED: corpus not found at {CORPUS}; set ST_CORPUS", flush=True)
        sys.exit(77)
    for arguments in checks:
        name = arguments[0].split(".")[0]
        setattr(case, f"test_{name}", lambda self, arguments=arguments: self.check(*arguments))
    unittest.main(verbosity=2)
