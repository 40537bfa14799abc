#!/usr/bin/env python3
"""st-check allows what the sizes imply, not what the mesh has."""
import os
import struct
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from chain import INCOMPLETE, MODELS, OK, Run, ToolTest, artifacts_of, make_chain, must  # noqa: E402

HERE = Path(__file__).resolve().parent
VARIED_MODELS = Path(os.environ["ST_BIN"]).parent / "tests/support/varied_models"


def turn_triangle(stl, index):
    """Swaps two corners of a triangle of a binary STL file."""
    data = bytearray(stl.read_bytes())
    at = 84 + 50 * index + 12
    data[at:at + 24] = data[at + 12:at + 24] + data[at:at + 12]
    stl.write_bytes(data)


class CheckLimits(ToolTest):
    def check(self, at, mesh="mesh.hdf"):
        run = Run("st-check", Path(at) / mesh, "--geometry", Path(at) / "geometry.hdf", "--json")
        return run, run.json()

    def test_two_spheres_far_apart_fail_or_are_resolved(self):
        run, found = self.check(make_chain(HERE / "far_small.brep", self.folder / "far"))
        if abs(found["area_difference"]) > 0.01:
            self.assertEqual(run.code, INCOMPLETE, run)
            self.assertIn("areas", found["failed"])
            self.assertEqual(found["checks"]["below-sizes"]["count"], 1, "the sphere of a thousandth")

    def sphere(self, alpha):
        return make_chain(MODELS / "sphere.brep", self.folder / alpha,
                          raster_options=["--alpha", alpha, "--lmax", "60%"])

    def test_a_sphere_off_by_more_than_its_sizes_may_ask_for_fails_and_less_is_said(self):
        _, found = self.check(self.sphere("25"))
        self.assertEqual(found["failed"], ["areas", "cad-area"], "more than 3 % below")
        run = Run("st-check", self.sphere("15") / "mesh.hdf", "--geometry", self.folder / "15" / "geometry.hdf")
        self.assertEqual(run.code, OK, run)
        self.assertRegex(run.out, r"passes, area 1\.\d % below the CAD's, volume 2\.\d % below the CAD's")

    def test_a_boss_of_a_few_smallest_lengths_is_said_where_the_rest_is_large(self):
        """Its cap is four lengths wide, and lacks 6 % of its area."""
        subprocess.run([VARIED_MODELS, self.folder, "7031", "7031"], check=True, capture_output=True, timeout=100)
        (model,) = self.folder.glob("v7031*")
        at = make_chain(model, self.folder / "boss", raster_options=["--preset", "preview"])
        run, found = self.check(at)
        self.assertEqual(run.code, OK, run)
        self.assertEqual(found["checks"]["below-sizes"]["count"], 1)

    def test_turned_triangles_of_another_program_fail_with_and_without_geometry(self):
        at = artifacts_of("torus")
        stl = self.folder / "mesh.stl"
        must("st-export", at / "mesh.hdf", "-o", stl)
        triangles = struct.unpack("<I", stl.read_bytes()[80:84])[0]
        self.assertEqual(Run("st-check", stl, "--geometry", at / "geometry.hdf").code, OK)
        turn_triangle(stl, triangles // 2)
        for geometry in ([], ["--geometry", at / "geometry.hdf"]):
            run = Run("st-check", stl, *geometry, "--json")
            self.assertEqual(run.code, INCOMPLETE, run)
            self.assertEqual(run.json()["failed"], ["oriented"], run)
            self.assertEqual(run.json()["checks"]["oriented"]["count"], 3)


if __name__ == "__main__":
    unittest.main()
