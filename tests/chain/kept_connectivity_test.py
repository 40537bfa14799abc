"""st-remesh --moved --keep-connectivity: nodes follow the geometry, triangles stay; displacements of nodes."""
import csv
import json
import re
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import BIN, MISMATCH, MODELS, OK, USAGE, Run, ToolTest, content_hash, make_chain, must  # noqa: E402


class KeptConnectivity(ToolTest):
    def sized(self, model, *raster_options):
        """Geometry and sizing of a model of the tests."""
        folder = self.folder / model
        folder.mkdir(exist_ok=True)
        must("st-import", MODELS / f"{model}.brep", "-o", folder / "geometry.hdf", "--unit", "mm")
        must("st-raster", folder / "geometry.hdf", "-o", folder / "raster.hdf", *raster_options)
        must("st-prolong", folder / "raster.hdf", "-o", folder / "sizing.hdf")
        return folder / "geometry.hdf", folder / "sizing.hdf"

    def move(self, mesh, model, merged, *options):
        run = Run("st-remesh", mesh, *self.sized(model), "--moved", "--keep-connectivity", "--merged", merged, "--json",
                  *options)
        self.assertEqual(run.code, OK, str(run))
        return run.json(), run.err

    def cells(self, mesh):
        """Triangles as node numbers, in ASCII of .off."""
        off = self.folder / "cells.vtu"
        must("st-export", mesh, "-o", off)
        text = off.read_text()
        return text[text.index('Name="connectivity"'):text.index('Name="offsets"')]

    def test_a_wing_twisted_in_ten_steps_keeps_all_triangles(self):
        first = make_chain(MODELS / "twisted_wing_0.brep", self.folder / "first")
        mesh, cells, n = first / "mesh.hdf", self.cells(first / "mesh.hdf"), None
        for twist in range(2, 22, 2):
            moved = self.folder / f"{twist}.hdf"
            facts, said = self.move(mesh, f"twisted_wing_{twist}", moved)
            n = n or facts["triangles"]
            self.assertEqual((facts["triangles_kept"], facts["places"]), (n, []), twist)
            self.assertNotIn("--keep-connectivity", said)
            self.assertEqual(self.cells(moved), cells)
            mesh = moved
        check = must("st-check", mesh, "--geometry", self.folder / "twisted_wing_20" / "geometry.hdf", "--json").json()
        self.assertGreater(check["quality"]["min"], 0.4)

    def test_stretched_triangles_are_judged_by_their_sizes(self):
        stretch = ["--max-aspect", 16]
        first = make_chain(MODELS / "twisted_wing_0.brep", self.folder / "first", raster_options=stretch)
        quality = must("st-check", first / "mesh.hdf", "--json").json()["quality"]["p1"]
        self.assertLess(quality, 0.3, "in space they are below the bound")
        facts = must("st-remesh", first / "mesh.hdf", *self.sized("twisted_wing_4", *stretch), "--moved",
                     "--keep-connectivity", "--dry-run", "--json").json()
        self.assertEqual(facts["triangles_kept"], facts["triangles_before"])

    def test_a_flap_turned_by_20_degrees_says_where_not(self):
        first = make_chain(MODELS / "part_flapped_wing_5.brep", self.folder / "first")
        hashes = set()
        for options in ((), ("--threads", 1), ("--threads", 3), ("--np", 2), ("--np", 3)):
            merged = self.folder / "turned.hdf"
            facts, said = self.move(first / "mesh.hdf", "part_flapped_wing_25", merged, *options)
            hashes.add((content_hash(merged), json.dumps(facts["places"])))
            self.assertIn(f"{facts['triangles_before'] - facts['triangles_kept']} of", said)
        self.assertEqual(len(hashes), 1)
        self.assertEqual(len(facts["places"]), 2, "the walls on both sides of the flap")
        for place, y in zip(sorted(facts["places"], key=lambda p: p["at"][1]), (12, 28)):
            self.assertAlmostEqual(place["at"][1], y, delta=1)
            self.assertGreater(place["at"][0], 42, "behind the hinge")
            self.assertIn(f"group {place['group']}: {place['triangles']} triangles", said)
        self.assertLess(sum(p["triangles"] for p in facts["places"]), 0.05 * facts["triangles_before"])
        must("st-check", merged, "--geometry", self.folder / "part_flapped_wing_25" / "geometry.hdf")

    def test_the_example_draws_the_wall_beside_the_flap(self):
        script = Path(__file__).resolve().parents[2] / "examples" / "flap" / "keep_triangles.sh"
        done = subprocess.run([script, MODELS / "part_flapped_wing_5.brep", MODELS / "part_flapped_wing_25.brep",
                               self.folder, BIN], capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, OK, done.stdout + done.stderr)
        drawn = (self.folder / "kept.svg").read_text()
        self.assertEqual(drawn, (script.parent / "kept.svg").read_text())
        self.assertGreater(drawn.count("#f5a142"), 50)

    def test_displacements_are_those_of_the_nodes(self):
        first = make_chain(MODELS / "flapped_wing_0.brep", self.folder / "first")
        table, view = self.folder / "by.csv", self.folder / "by.vtu"
        for file in (table, view):
            facts, _ = self.move(first / "mesh.hdf", "flapped_wing_20", self.folder / "m.hdf", "--displacements", file)
        self.assertEqual(facts["triangles_kept"], facts["triangles_before"])
        before, after = (self.points(m) for m in (first / "mesh.hdf", self.folder / "m.hdf"))
        with table.open() as lines:
            rows = [[float(v) for v in row.values()] for row in csv.DictReader(lines)]
        self.assertEqual(len(rows), len(before))
        moved = 0
        for n, (row, x, y) in enumerate(zip(rows, before, after)):
            self.assertEqual(row[:4], [n, *x])
            for k in range(3):
                self.assertAlmostEqual(row[4 + k], y[k] - x[k], delta=1e-9)
            moved = max(moved, abs(row[6]))
        self.assertAlmostEqual(moved, 18 * 0.342, delta=0.2)  # the tail: 18 sin(20 deg)
        self.assertIn('Name="displacement" NumberOfComponents="3"', view.read_text())

    def points(self, mesh):
        obj = self.folder / "points.obj"
        must("st-export", mesh, "-o", obj)
        return [tuple(map(float, line.split()[1:4])) for line in obj.read_text().split("\n") if line.startswith("v ")]

    def test_what_makes_no_sense_is_refused(self):
        first = make_chain(MODELS / "box.brep", self.folder / "first")
        inputs = [first / "mesh.hdf", first / "geometry.hdf", first / "sizing.hdf"]
        for options in (["--keep-connectivity"], ["--displacements", self.folder / "by.csv"]):
            self.expect_error(USAGE, "st-remesh", *inputs, "-o", self.folder / "p.hdf", *options, says="--moved")
        self.expect_error(USAGE, "st-remesh", *inputs, "-o", self.folder / "p.hdf", "--moved", "--displacements",
                          self.folder / "by.txt", says=".csv")

    def test_a_geometry_on_which_nothing_keeps_its_shape_is_refused(self):
        first = make_chain(MODELS / "box.step", self.folder / "first")
        flat = self.folder / "flat.step"
        flat.write_text(re.sub(r"CARTESIAN_POINT\(''\s*,\s*\(([^,)]*),([^,)]*),([^,)]*)\)\)",
                               lambda m: f"CARTESIAN_POINT('',({m[1]},{0.05 * float(m[2])!r},{0.002 * float(m[3])!r}))",
                               (MODELS / "box.step").read_text()))
        must("st-import", flat, "-o", self.folder / "flat.hdf")
        must("st-raster", self.folder / "flat.hdf", "-o", self.folder / "raster.hdf")
        must("st-prolong", self.folder / "raster.hdf", "-o", self.folder / "sizing.hdf")
        run = Run("st-remesh", first / "mesh.hdf", self.folder / "flat.hdf", self.folder / "sizing.hdf", "--moved",
                  "--keep-connectivity", "--merged", self.folder / "m.hdf")
        self.assertEqual(run.code, MISMATCH, str(run))
        self.assertIn("no triangle", run.err)
        self.assertFalse((self.folder / "m.hdf").exists())


if __name__ == "__main__":
    unittest.main(verbosity=2)
