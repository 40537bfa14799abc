"""st-import --mirror: the mesh of a symmetric model is its own image, whatever the ranks and threads."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import GEOMETRY, MODELS, OK, USAGE, Run, ToolTest, make_chain, must  # noqa: E402

MIDDLE = 20  # of the box, 60 x 40 x 20 mm, in y
DIGITS = 9  # of coordinates: images at 40 - y are exact to rounding; unit tests compare bits about y = 0


def triangles(folder):
    """Corners of each."""
    must("st-export", folder / "mesh.hdf", "-o", folder / "mesh.obj")
    lines = [line.split() for line in (folder / "mesh.obj").read_text().split("\n")]
    nodes = [tuple(round(float(x), DIGITS) + 0.0 for x in words[1:]) for words in lines if words[:1] == ["v"]]
    found = [tuple(nodes[int(n.partition("/")[0]) - 1] for n in words[1:]) for words in lines if words[:1] == ["f"]]
    assert len(found) > 100
    return found


def from_least(corners):
    first = corners.index(min(corners))
    return corners[first:] + corners[:first]


def image(point):
    return (point[0], round(2 * MIDDLE - point[1], DIGITS) + 0.0, point[2])


def without_image(found):
    """Triangles of which no other one is the image, turned over."""
    there = {from_least(corners) for corners in found}
    images = {from_least((image(a), image(c), image(b))) for a, b, c in found}
    return there ^ images


class Mirrored(ToolTest):
    def chain(self, name, **options):
        return make_chain(MODELS / "box.step", self.folder / name, **options)

    def mirrored(self, name, *more, **options):
        return self.chain(name, import_options=["--mirror", f"y={MIDDLE}", *more], **options)

    def test_a_mesh_is_its_own_image_and_passes(self):
        folder = self.mirrored("whole")
        self.assertEqual(without_image(triangles(folder)), set())
        must("st-check", folder / "mesh.hdf", "--geometry", folder / "geometry.hdf", "--sizing", folder / "sizing.hdf")

    def test_the_air_around_a_body_is_its_own_image(self):
        folder = self.mirrored("air", "--farfield", "sphere:5")
        self.assertEqual(without_image(triangles(folder)), set())
        must("st-check", folder / "mesh.hdf", "--geometry", folder / "geometry.hdf")

    def test_a_source_on_one_side_refines_both(self):
        source = self.folder / "source.toml"
        source.write_text('[[source]]\ntype = "point"\nat = [10, 2, 20]\nlength = 0.5\nradius = 3\n')
        folder = self.mirrored("source", prolong_options=["--sources", source])
        self.assertEqual(without_image(triangles(folder)), set())
        self.assertGreater(len(triangles(folder)), 1.1 * len(triangles(self.mirrored("plain"))))

    def test_ranks_and_threads_give_the_same_bits(self):
        one = self.mirrored("one", mesh_options=["--threads", "1"])
        for name, options in (("ranks", {"n_ranks": 2}), ("threads", {"mesh_options": ["--threads", "3"]})):
            self.assertEqual((self.mirrored(name, **options) / "mesh.hdf").read_bytes(),
                             (one / "mesh.hdf").read_bytes(), name)

    def test_st_run_takes_the_option(self):
        folder = self.mirrored("single")
        must("st-run", MODELS / "box.step", "--mirror", f"y={MIDDLE}", "-o", self.folder / "run.hdf")
        self.assertEqual((self.folder / "run.hdf").read_bytes(), (folder / "mesh.hdf").read_bytes())

    def test_the_other_sign_keeps_the_other_half(self):
        folder = self.chain("below", import_options=["--mirror", f"y={MIDDLE}-"])
        self.assertEqual(without_image(triangles(folder)), set())

    def test_what_is_not_symmetric_is_refused_with_its_places(self):
        run = Run("st-import", MODELS / "box.step", "-o", self.folder / "geometry.hdf", "--mirror", "y=19")
        self.assertEqual(run.code, GEOMETRY, run)
        self.assertRegex(run.err, r"not symmetric about y = 19 within 0\.0\d+: \d+ faces have no image: .*off by 2 ")
        self.assertFalse((self.folder / "geometry.hdf").exists())

    def test_parts_and_joined_faces_are_refused(self):
        folder = self.mirrored("parts")
        inputs = [folder / "geometry.hdf", folder / "sizing.hdf", "-o", self.folder / "part.hdf"]
        for options in (["--faces", "1"], ["--edges", folder / "patches.hdf"]):
            run = Run("st-mesh", *inputs, *options)
            self.assertEqual(run.code, USAGE, run)
            self.assertIn("was imported with --mirror", run.err)
        run = Run("st-import", MODELS / "box.step", "-o", self.folder / "g.hdf", "--mirror", "y=20", "--composite",
                  "harm")
        self.assertEqual(run.code, USAGE, run)
        self.assertEqual(Run("st-mesh", *inputs).code, OK)


if __name__ == "__main__":
    unittest.main()
