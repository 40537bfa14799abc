"""The same artifacts and the same verdict for every number of threads and ranks."""
import json
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import MODELS, ToolTest, content_hash, make_chain, must  # noqa: E402

SETTINGS = [(1, 1), (1, 2), (1, 3), (1, 8), (2, 2), (3, 1)]  # ranks, threads
SOURCE = '[[source]]\ntype = "point"\nat = [10, 10, 10]\nlength = "0.8%"\nradius = "10%"\n'


class Threads(ToolTest):
    def expect_one(self, results):
        self.assertEqual(len(set(results.values())), 1, results)

    def settings(self, ranks, threads):
        return ["--np", ranks, "--threads", threads]

    def test_raster_and_mesh_are_the_same_bits(self):
        for model, options in (("wing_with_flap.step", ["--gap-cells", "2"]), ("assembly.step", ["--lmax", "3%"])):
            chain = make_chain(MODELS / model, self.folder / model, raster_options=options)
            rasters, patches = {}, {}
            for setting in SETTINGS:
                must("st-raster", chain / "geometry.hdf", "-o", chain / "r.hdf", *options, *self.settings(*setting))
                must("st-mesh", chain / "geometry.hdf", chain / "sizing.hdf", "-o", chain / "p.hdf", "--tile", "1000",
                     *self.settings(*setting))
                rasters[setting] = content_hash(chain / "r.hdf")
                patches[setting] = content_hash(chain / "p.hdf")
            self.expect_one(rasters)
            self.expect_one(patches)

    def test_geometry_and_sizes_are_the_same_bits(self):
        for model in ("wing_with_flap.step", "assembly.step"):
            geometries, sizes = {}, {}
            for n_threads in (1, 2, 3, 8):
                g, r, s = (self.folder / f"{name}.hdf" for name in ("g", "r", "s"))
                must("st-import", MODELS / model, "-o", g, "--threads", n_threads)
                geometries[n_threads] = content_hash(g)
                must("st-raster", g, "-o", r, "--lmax", "1%")
                must("st-prolong", r, "-o", s, "--threads", n_threads)
                sizes[n_threads] = content_hash(s)
            self.expect_one(geometries)
            self.expect_one(sizes)

    def test_a_remeshing_is_the_same_bits(self):
        chain = make_chain(MODELS / "block_with_hole.step", self.folder / "chain", raster_options=["--lmax", "3%"])
        (self.folder / "s.toml").write_text(SOURCE)
        must("st-prolong", chain / "raster.hdf", "-o", chain / "s.hdf", "--sources", self.folder / "s.toml")
        meshes = {}
        for setting in SETTINGS:
            must("st-remesh", chain / "mesh.hdf", chain / "geometry.hdf", chain / "s.hdf", "--merged", chain / "m.hdf",
                 *self.settings(*setting))
            meshes[setting] = content_hash(chain / "m.hdf")
        self.expect_one(meshes)

    def test_the_verdict_is_the_same_text(self):
        chain = make_chain(MODELS / "torus.brep", self.folder / "chain",
                           raster_options=["--lmax", "0.6%", "--lmin", "0.3%"])
        reports = {}
        for n_threads in (1, 2, 3, 8):
            run = must("st-check", chain / "mesh.hdf", "--geometry", chain / "geometry.hdf", "--sizing",
                       chain / "sizing.hdf", "--json", "--report", chain / "report.json", "--threads", n_threads)
            self.assertGreater(run.json()["triangles"], 50000, "several pieces of each loop")
            report = json.loads((chain / "report.json").read_text())
            report.pop("seconds")
            reports[n_threads] = json.dumps(report)
        self.expect_one(reports)


if __name__ == "__main__":
    unittest.main(verbosity=2)
