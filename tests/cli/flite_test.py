"""FLITE geometry files: imported, meshed, written, and refused where they are damaged."""
import math
import os
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import INPUT, MODELS, ToolTest, make_chain, must  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
CORPUS = Path(os.environ.get("ST_CORPUS", ""))
CYLINDERS = CORPUS / "flite_zju_cylinders.fli"
needs_corpus = unittest.skipUnless(CYLINDERS.is_file(), "LOUD: no FLITE file here; set ST_CORPUS")


def surfaces_of(path):
    """Grids of points of a FLITE file."""
    lines = iter(Path(path).read_text().splitlines())
    next(lines)
    n_curves, n_surfaces = map(int, next(lines).split())
    next(lines)
    for _ in range(n_curves):
        next(lines)
        for _ in range(int(next(lines))):
            next(lines)
    next(lines)
    for _ in range(n_surfaces):
        next(lines)
        n, m = map(int, next(lines).split())
        yield [[tuple(map(float, next(lines).split())) for _ in range(n)] for _ in range(m)]


class FliteTest(ToolTest):
    def geometry(self, model, name="g.hdf", *options):
        """Artifact and report of a model."""
        return self.folder / name, must("st-import", model, "-o", self.folder / name, "--json", *options).json()

    def written(self, model, *options):
        """The model as model.dat, and the reports of import and export."""
        artifact, report = self.geometry(model)
        export = must("st-export", artifact, "-o", self.folder / "model.dat", "--json", *options).json()
        return self.folder / "model.dat", report, export

    def expect_checked_mesh(self, model):
        folder = make_chain(model, self.folder / "chain")
        must("st-check", folder / "mesh.hdf", "--geometry", folder / "geometry.hdf", "--sizing", folder / "sizing.hdf")


class Fighter(FliteTest):
    """The model of bench/paper.sh, with fewer panels."""

    def test_is_closed_in_its_far_field_and_no_panel_is_like_another(self):
        files = self.folder / "fighter.dat", self.folder / "fighter.toml"
        subprocess.run([sys.executable, "-B", ROOT / "examples/store/fighter.py", *files, "--panels", "12x8"],
                       check=True)
        geometry, report = self.geometry(files[0], "g.hdf", "--groups", files[1], "--unit", "m")
        self.assertEqual((report["faces"], report["closed"]), (2 * 12 * 8 + 2 + 2 * (10 * 8 + 2) + 6, True), report)
        info = must("st-info", geometry, "--groups", "--json").json()
        n_faces = {group["name"]: len(group["faces"]) for group in info["tables"][0]["groups"]}
        self.assertEqual((n_faces["symmetry"], n_faces["farfield"], n_faces["skin_above"]), (1, 5, 96))
        sides = [tuple(round(math.dist(a, b), 9) for a, b in ((g[0][0], g[0][-1]), (g[0][0], g[-1][0]),
                                                              (g[-1][-1], g[0][-1]), (g[-1][-1], g[-1][0])))
                 for g in surfaces_of(files[0]) if len(g) > 2]
        self.assertEqual(len(sides), 2 * 12 * 8 + 2 * 10 * 8)
        self.assertEqual(len(set(sides)), len(sides))


class Import(FliteTest):
    @needs_corpus
    def test_files_of_another_program_become_a_checked_mesh(self):
        for name, faces in (("cylinders", 8), ("trefoil", 30)):
            model = CORPUS / f"flite_zju_{name}.fli"
            report = self.geometry(model)[1]
            self.assertEqual((report["format"], report["faces"], report["closed"], report["unit"]),
                             ("FLITE", faces, True, ""))
            self.expect_checked_mesh(model)
            shutil.rmtree(self.folder / "chain")

    @needs_corpus
    def test_unit_is_what_the_user_says(self):
        plain, metres = self.geometry(CYLINDERS)[1], self.geometry(CYLINDERS, "m.hdf", "--unit", "m")[1]
        self.assertEqual((metres["unit"], metres["box"]), ("m", plain["box"]))

    @needs_corpus
    def test_regions_are_groups(self):
        names = [g["name"] for g in self.geometry(CYLINDERS)[1]["tables"][0]["groups"]]
        self.assertEqual(names, [f"region {k}" for k in range(1, 9)])

    @needs_corpus
    def test_content_decides_not_the_suffix(self):
        shutil.copy(MODELS / "box.step", self.folder / "box.dat")
        shutil.copy(CYLINDERS, self.folder / "cylinders.step")
        self.assertEqual(self.geometry(self.folder / "box.dat")[1]["format"], "STEP")
        self.assertEqual(self.geometry(self.folder / "cylinders.step")[1]["format"], "FLITE")

    @needs_corpus
    def test_damaged_files_are_refused_with_their_line(self):
        text = CYLINDERS.read_text()
        cases = {"cut": (text[:20000], "cut off"),
                 "number": (text.replace("-7.500000e-001", "-7.5x0000e-001", 1), "line 7: curve 1 of 18"),
                 "garbage": ("\x01\x02garbage\n" * 50, "line 2")}
        for name, (content, says) in cases.items():
            path = self.folder / f"{name}.fli"
            path.write_text(content)
            self.expect_error(INPUT, "st-import", path, "-o", self.folder / "x.hdf", says=says)
            self.assertFalse((self.folder / "x.hdf").exists())


class Export(FliteTest):
    def test_box_and_drilled_block_come_back_and_mesh(self):
        for name, regions in (("box.step", 6), ("block_with_hole.step", 8)):
            model, before, export = self.written(MODELS / name)
            self.assertEqual(export["regions"], regions)
            self.assertLessEqual(export["deviation"], export["tolerance"])
            after = self.geometry(model, "again.hdf")[1]
            self.assertEqual((after["format"], after["faces"], after["closed"], after["solids"]),
                             ("FLITE", regions, True, 1))
            self.assertAlmostEqual(after["volume"] / before["volume"], 1, delta=1e-4)
            self.expect_checked_mesh(model)
            shutil.rmtree(self.folder / "chain")

    def test_closed_faces_are_divided_and_said(self):
        model, before, export = self.written(MODELS / "sphere.brep")
        self.assertEqual((export["faces"], export["faces_divided"], export["regions"]), (1, 1, 2))
        self.expect_checked_mesh(model)

    def test_tolerance_is_kept(self):
        sizes = []
        for tolerance in ("1%", "0.001%"):
            model, _, export = self.written(MODELS / "sphere.brep", "--tolerance", tolerance)
            self.assertLessEqual(export["deviation"], export["tolerance"])
            sizes.append(model.stat().st_size)
        self.assertLess(2 * sizes[0], sizes[1])

    def test_tolerance_out_of_reach_is_a_warning(self):
        artifact = self.geometry(MODELS / "sphere.brep")[0]
        run = must("st-export", artifact, "-o", self.folder / "m.dat", "--tolerance", "1e-14")
        self.assertIn("is not reached", run.err)

    def test_geometry_has_no_other_format(self):
        artifact = self.geometry(MODELS / "box.step")[0]
        self.expect_error(INPUT, "st-export", artifact, "-o", self.folder / "m.stl", says=".dat")
        self.assertFalse((self.folder / "m.stl").exists())


if __name__ == "__main__":
    unittest.main()
