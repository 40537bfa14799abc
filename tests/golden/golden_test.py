"""Artifacts of small models against stored ones, compared by st-diff: of every stage at least one. A missing golden
fails.

usage: golden_test.py             compare (in ctest)
       golden_test.py --update    write the goldens anew: a commit of its own, with the numbers before and after and the
       reason
"""
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import MODELS, OK, Run, ToolTest, must  # noqa: E402

GOLDEN = Path(__file__).resolve().parent
TOLERANCE = "1e-9"  # other processors round sines and cosines differently in the last bit
MESH_TOLERANCE = "1e-6"  # and such a bit can turn one of the enhancer's weights, which have single precision
MESHES = {"dome.patches.hdf", "dome.mesh.hdf", "dome.remesh.hdf"}
LIMIT = 50_000  # bytes of stored test data
# On the dome neither limit cuts the lengths that 20 degrees ask for.
DOME_LIMITS = ["--lmin", "2%", "--lmax", "20%"]
DOME_SCALE = ["--scale", "1.8"]  # few triangles
# A finer place at the rim, so that lengths vary along the edge, and another one for st-remesh.
AT_RIM, AT_WALL = [9, 3, 1], [-6, 0, 18]


def raster_dome(folder, name, alpha):
    """The summary of st-raster."""
    geometry = folder / "dome.geometry.hdf"
    return must("st-raster", geometry, "-o", folder / name, *DOME_LIMITS, "--alpha", alpha, "--json").json()


def prolong_dome(folder, name, fine_place):
    source = f'[[source]]\ntype = "sphere"\nat = {fine_place}\nextent = 1\nlength = 1.5\n'
    with tempfile.TemporaryDirectory() as elsewhere:
        sources = Path(elsewhere) / "sources.toml"
        sources.write_text(source)
        must("st-prolong", folder / "dome.raster.hdf", "-o", folder / name, *DOME_SCALE, "--sources", sources)


def make_geometries(folder):
    for model in ("assembly.step", "block_with_hole.step", "box.igs", "dome.brep"):
        must("st-import", MODELS / model, "-o", folder / f"{model.split('.')[0]}.geometry.hdf")


def make_all(folder):
    """The artifacts that have goldens, in `folder`; returns their names."""
    make_geometries(folder)
    stages = ("geometry", "sizing", "patches", "mesh", "changed", "remesh")
    geometry, sizing, patches, mesh, changed, remesh = (folder / f"dome.{stage}.hdf" for stage in stages)
    raster_dome(folder, "dome.raster.hdf", 20)
    prolong_dome(folder, sizing.name, AT_RIM)
    must("st-mesh", geometry, sizing, "-o", patches)
    must("st-merge", patches, "-o", mesh)
    prolong_dome(folder, changed.name, AT_WALL)
    must("st-remesh", mesh, geometry, changed, "--merged", remesh)
    changed.unlink()
    return sorted(p.name for p in folder.glob("*.hdf"))


class Golden(ToolTest):
    def test_artifacts_equal_their_goldens(self):
        for name in make_all(self.folder):
            with self.subTest(name):
                missing = f"golden {name} is missing; {Path(__file__).name} --update writes it"
                self.assertTrue((GOLDEN / name).is_file(), missing)
                self.assertLess((GOLDEN / name).stat().st_size, LIMIT)
                tolerance = MESH_TOLERANCE if name in MESHES else TOLERANCE
                run = Run("st-diff", GOLDEN / name, self.folder / name, "--tolerance", tolerance)
                self.assertEqual(run.code, OK, run)

    def test_lengths_of_the_dome_vary_with_its_curvature(self):
        """Else the goldens would not notice how curvature is sampled."""
        make_geometries(self.folder)
        runs = {alpha: raster_dome(self.folder, f"{alpha}.hdf", alpha) for alpha in (5, 10, 20)}
        for finer, coarser in ((5, 10), (10, 20)):
            for count in ("samples", "cells"):
                self.assertGreater(runs[finer][count], 1.5 * runs[coarser][count], (count, finer, coarser))
        field = must("st-prolong", self.folder / "20.hdf", "-o", self.folder / "sizing.hdf", "--json").json()
        self.assertGreater(field["lmin"], 1.2 * runs[20]["lmin"])
        self.assertGreater(field["lmax"], 3 * field["lmin"])
        self.assertLess(field["lmax"], runs[20]["lmax"])

    def test_every_golden_has_its_artifact(self):
        made = make_all(self.folder)
        self.assertEqual([p.name for p in sorted(GOLDEN.glob("*.hdf"))], made)


if __name__ == "__main__":
    if "--update" in sys.argv:
        print("\n".join(make_all(GOLDEN)))
    else:
        unittest.main(verbosity=2)
