"""Joined faces: what users read and write has the numbers of the CAD, and what cannot be joined is said."""
import re
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import INCOMPLETE, MISMATCH, MODELS, OK, USAGE, Run, ToolTest, make_chain, must  # noqa: E402

MODEL = MODELS / "wing_of_8.brep"
AREAS = """
import sys, h5py, numpy
mesh, cad = h5py.File(sys.argv[1]), h5py.File(sys.argv[2])["st/face/area"][:]
x, t = mesh["VTKHDF/Points"][:], mesh["VTKHDF/Connectivity"][:].reshape(-1, 3)
areas = numpy.linalg.norm(numpy.cross(x[t[:, 1]] - x[t[:, 0]], x[t[:, 2]] - x[t[:, 0]]), axis=1) / 2
faces = mesh["VTKHDF/CellData/cad_face"][:] - 1
own = numpy.bincount(faces, weights=areas, minlength=len(cad))
for f, (a, b) in enumerate(zip(own, cad)):
    if abs(a - b) > 0.15 * b and b > 20 * areas.max():
        print("face", f + 1, "has", a, "of", b)
inside = mesh["VTKHDF/PointData/entity_dim"][:] == 2
if ((mesh["VTKHDF/PointData/cad_face"][:] > 0) != inside).any():
    print("nodes inside faces and others are mixed up")
"""
VERTEX = '[[group]]\nname = "tap"\nof = "vertices"\nvertices = [{}]\n'


class Composite(ToolTest):
    def chain(self, *options):
        make_chain(MODEL, self.folder, import_options=["--composite", "smooth", *options])
        return self.folder

    def joined(self, *options):
        """What st-import says of the model."""
        run = must("st-import", MODEL, "-o", self.folder / "g.hdf", "--composite", "smooth", "--json", *options)
        return run.json()

    def test_both_numbers_of_faces_are_said(self):
        plain = must("st-import", MODEL, "-o", self.folder / "plain.hdf", "--composite", "none", "--json").json()
        usual = must("st-import", MODEL, "-o", self.folder / "usual.hdf", "--json").json()
        run = must("st-import", MODEL, "-o", self.folder / "g.hdf", "--composite", "smooth")
        said = self.joined()
        self.assertEqual(said["faces"], plain["faces"])
        self.assertLess(said["joined"]["faces"], said["faces"])
        self.assertNotIn("joined", plain)
        self.assertLess(usual["joined"]["faces"], usual["faces"])
        self.assertIn(f"{said['faces']} faces, ", run.out)
        self.assertIn(f"{said['joined']['faces']} faces and {said['joined']['edges']} edges after joining", run.out)
        info = must("st-info", self.folder / "g.hdf", "--json").json()
        self.assertEqual((info["counts"]["faces"], info["joined"]["faces"]), (said["faces"], said["joined"]["faces"]))
        self.assertEqual((info["schema_version"], plain["faces"]), (2, said["faces"]))
        self.assertEqual(must("st-info", self.folder / "plain.hdf", "--json").json()["schema_version"], 1)

    def test_groups_have_the_numbers_of_the_cad(self):
        said = self.joined()
        groups = must("st-info", "--groups", self.folder / "g.hdf", "--json").json()["tables"][0]["groups"]
        self.assertEqual(sorted(f for g in groups for f in g["faces"]), list(range(1, said["faces"] + 1)))

    def test_meshes_name_faces_of_the_cad(self):
        python = "/usr/bin/python3"
        if subprocess.run([python, "-c", "import h5py"], capture_output=True).returncode != 0:
            self.skipTest("LOUD: /usr/bin/python3 has no h5py, nobody can read the meshes")
        folder = self.chain()
        must("st-remesh", folder / "mesh.hdf", folder / "geometry.hdf", folder / "sizing.hdf", "--merged",
             folder / "again.hdf")
        for mesh in (folder / "mesh.hdf", folder / "again.hdf"):
            said = subprocess.run([python, "-c", AREAS, mesh, folder / "geometry.hdf"], capture_output=True, text=True)
            self.assertEqual((said.returncode, said.stdout), (0, ""), said.stderr)

    def test_parts_meshed_one_by_one_are_merged_into_the_same_mesh(self):
        folder = self.chain()
        inputs = folder / "geometry.hdf", folder / "sizing.hdf"
        n_faces = must("st-info", inputs[0], "--json").json()["counts"]["faces"]
        said = must("st-mesh", *inputs, "--faces", "1", "-o", folder / "a.hdf").err
        joined = set(map(int, re.search(r"faces ([0-9, ]+) are joined", said)[1].split(",")))
        rest = ",".join(str(f) for f in range(1, n_faces + 1) if f not in joined)
        must("st-mesh", *inputs, "--faces", rest, "--edges", folder / "a.hdf", "-o", folder / "b.hdf")
        self.expect_error(INCOMPLETE, "st-merge", folder / "a.hdf", "-o", folder / "m.hdf", says="no complete mesh")
        must("st-merge", folder / "a.hdf", folder / "b.hdf", "-o", folder / "m.hdf")
        must("st-diff", folder / "m.hdf", folder / "mesh.hdf")

    def test_vertices_of_groups_stay(self):
        all_joined, n_vertices = self.joined()["joined"], self.joined()["vertices"]
        self.assertLess(all_joined["vertices"], n_vertices)
        groups = self.folder / "groups.toml"
        for v in range(1, n_vertices + 1):
            groups.write_text(VERTEX.format(v))
            self.joined("--groups", groups)
            tables = must("st-info", "--groups", self.folder / "g.hdf", "--json").json()["tables"]
            self.assertIn("tap", [g["name"] for g in tables[0]["groups"]])
            made = make_chain(MODEL, self.folder / str(v), import_options=["--composite", "smooth", "--groups", groups])
            mesh = must("st-info", "--groups", self.folder / str(v) / "mesh.hdf", "--json").json()
            taps = [g for g in mesh["tables"][0]["groups"] if g["name"] == "tap"]
            self.assertEqual([len(g["vertices"]) for g in taps], [1], (v, made))

    def test_nothing_is_joined_by_a_check(self):
        self.expect_error(USAGE, "st-import", MODEL, "--check", "--composite", "smooth", says="--check writes nothing")

    def test_meshes_of_other_programs_lie_on_composites(self):
        folder, python = self.chain(), "/usr/bin/python3"
        must("st-export", folder / "mesh.hdf", "-o", folder / "joined.vtu")
        make_chain(MODEL, folder / "apart", import_options=["--composite", "none"])
        must("st-export", folder / "apart" / "mesh.hdf", "-o", folder / "apart.vtu")
        must("st-export", folder / "apart" / "mesh.hdf", "-o", folder / "apart.stl")
        for mesh in ("joined.vtu", "apart.vtu", "apart.stl"):
            run = must("st-remesh", folder / mesh, folder / "geometry.hdf", folder / "sizing.hdf", "--merged",
                       folder / "n.hdf", "--json")
            if mesh == "joined.vtu":
                self.assertEqual(run.json()["triangles_redone"], 0)
            self.assertLess(run.json()["triangles_redone"], 0.05 * run.json()["triangles"], mesh)
            self.assertEqual(Run("st-check", folder / "n.hdf", "--geometry", folder / "geometry.hdf").code, OK, mesh)
            said = subprocess.run([python, "-c", AREAS, folder / "n.hdf", folder / "geometry.hdf"], capture_output=True,
                                  text=True)
            if "No module named" not in said.stderr:
                self.assertEqual((said.returncode, said.stdout), (0, ""), said.stderr)
        for mesh in ("mesh.hdf", "joined.vtu"):
            self.assertEqual(Run("st-check", folder / mesh, "--geometry", folder / "geometry.hdf").code, OK, mesh)

    def test_numbers_are_those_of_the_cad(self):
        folder = self.chain()
        info = must("st-info", folder / "geometry.hdf", "--json").json()
        faces = must("st-info", folder / "mesh.hdf", "--groups", "--json").json()["tables"][0]["groups"]
        self.assertEqual(sorted(f for g in faces for f in g["faces"]), list(range(1, info["counts"]["faces"] + 1)))
        rule = '[[size]]\nfaces = [{}]\nlmax = "1%"\n'
        hashes = {}
        for face in range(1, info["counts"]["faces"] + 1):
            (folder / "sizes.toml").write_text(rule.format(face))
            run = must("st-raster", folder / "geometry.hdf", "-o", folder / f"r{face}.hdf", "--sizes",
                       folder / "sizes.toml", "--json")
            hashes.setdefault("are apart" in run.err + run.out, {})[face] = run.json()["hash"]
        self.assertEqual(len(hashes[True]), 8, hashes)  # each of two skins' four
        self.assertGreater(len(set(hashes[True].values())), 2, hashes)  # and not a skin as a whole

        part = next(iter(hashes[True]))  # st-mesh sees that its sizes are for faces that are apart
        must("st-prolong", folder / f"r{part}.hdf", "-o", folder / "s.hdf")
        must("st-mesh", folder / "geometry.hdf", folder / "s.hdf", "-o", folder / "p.hdf")
        must("st-merge", folder / "p.hdf", "-o", folder / "m.hdf")
        self.assertNotIn("joined", must("st-info", folder / "m.hdf", "--json").json())
        self.assertEqual(Run("st-check", folder / "m.hdf", "--geometry", folder / "geometry.hdf").code, OK)

    def test_a_part_of_a_composite_is_meshed_whole(self):
        folder = self.chain()
        run = must("st-mesh", folder / "geometry.hdf", folder / "sizing.hdf", "-o", folder / "p.hdf", "--faces", "2-3",
                   "--json")
        self.assertEqual(run.json()["faces_meshed"], 1)
        self.assertIn("are joined", run.err + run.out)

    def test_edits_keep_composites_that_move_as_one(self):
        folder = self.chain()
        must("st-edit", folder / "geometry.hdf", "-o", folder / "moved.hdf", "--transform", "rotate 0 0 1 10")
        before, after = (must("st-info", folder / f, "--json").json()["joined"] for f in ("geometry.hdf", "moved.hdf"))
        self.assertEqual(before, after)
        must("st-raster", folder / "moved.hdf", "-o", folder / "r.hdf")
        must("st-prolong", folder / "r.hdf", "-o", folder / "s.hdf")
        must("st-remesh", folder / "mesh.hdf", folder / "moved.hdf", folder / "s.hdf", "--moved", "--merged",
             folder / "n.hdf")
        self.assertEqual(Run("st-check", folder / "n.hdf", "--geometry", folder / "moved.hdf").code, OK)

    def test_edits_keep_composites_that_are_scaled(self):
        folder = self.chain()
        must("st-edit", folder / "geometry.hdf", "-o", folder / "large.hdf", "--transform",
             "scale 2.5; rotate 0 1 1 20; translate 1 2 3")
        before, after = (must("st-info", folder / f, "--json").json()["joined"] for f in ("geometry.hdf", "large.hdf"))
        self.assertEqual(before, after)
        must("st-raster", folder / "large.hdf", "-o", folder / "r.hdf")
        must("st-prolong", folder / "r.hdf", "-o", folder / "s.hdf")
        run = must("st-remesh", folder / "mesh.hdf", folder / "large.hdf", folder / "s.hdf", "--moved",
                   "--keep-connectivity", "--merged", folder / "n.hdf", "--json")
        self.assertEqual(run.json()["triangles_redone"], 0)
        self.assertEqual(Run("st-check", folder / "n.hdf", "--geometry", folder / "large.hdf").code, OK)

    def test_a_mesh_is_not_put_onto_other_composites(self):
        folder = self.chain()
        run = must("st-edit", folder / "geometry.hdf", "-o", folder / "other.hdf", "--transform", "mirror 0 1 0")
        self.assertIn("are apart", run.err + run.out)
        self.assertNotIn("joined", must("st-info", folder / "other.hdf", "--json").json())
        must("st-raster", folder / "other.hdf", "-o", folder / "r.hdf")
        must("st-prolong", folder / "r.hdf", "-o", folder / "s.hdf")
        run = Run("st-remesh", folder / "mesh.hdf", folder / "other.hdf", folder / "s.hdf", "--moved", "--merged",
                  folder / "other_mesh.hdf")
        self.assertEqual(run.code, MISMATCH, run)
        self.assertIn("--composite none", run.err)

    def test_the_cad_is_exported_as_flite(self):
        folder = self.chain()
        must("st-export", folder / "geometry.hdf", "-o", folder / "all.dat")


if __name__ == "__main__":
    unittest.main(verbosity=2)
