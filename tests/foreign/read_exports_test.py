"""Exports read by programs of others: counts, area and triangles of each group are those of the mesh."""
import collections
import os
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

try:
    import meshio
    import numpy
except ImportError as e:
    print(f"SKIPPED: {e}; install python3-meshio and run with /usr/bin/python3")
    sys.exit(77)

BIN, MODELS = Path(os.environ["ST_BIN"]), Path(os.environ["ST_MODELS"])
WORK = Path(os.environ["ST_WORK"]) / "foreign"
NUMBERS = {"ugrid": "ugrid:ref", "lb8.ugrid": "ugrid:ref", "b8.ugrid": "ugrid:ref",
           "bdf": "nastran:ref", "nas": "nastran:ref", "mesh": "medit:ref"}


def run(tool, *arguments):
    done = subprocess.run([BIN / tool, *map(str, arguments), "-q"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done


def export(suffix):
    path = WORK / f"mesh.{suffix}"
    run("st-export", WORK / "mesh.hdf", "-o", path)
    return path


def area(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return 0.5 * numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1).sum()


class Exports(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        WORK.mkdir(parents=True)
        run("st-import", MODELS / "assembly.step", "-o", WORK / "geometry.hdf")
        run("st-raster", WORK / "geometry.hdf", "-o", WORK / "raster.hdf")
        run("st-prolong", WORK / "raster.hdf", "-o", WORK / "sizing.hdf")
        run("st-mesh", WORK / "geometry.hdf", WORK / "sizing.hdf", "-o", WORK / "patches.hdf")
        run("st-merge", WORK / "patches.hdf", "-o", WORK / "mesh.hdf")
        # The reference: text STL with a solid per group, and OFF with exact coordinates, read here by hand.
        cls.groups = collections.Counter()
        cls.names = []
        for line in export("ascii.stl").read_text().split("\n"):
            if line.startswith("solid "):
                cls.names.append(line[6:])
            elif line.startswith("facet"):
                cls.groups[len(cls.names)] += 1
        lines = export("off").read_text().split("\n")
        n_nodes, n_triangles, _ = map(int, lines[1].split())
        cls.points = numpy.array([line.split() for line in lines[2:2 + n_nodes]], dtype=float)
        rows = lines[2 + n_nodes:2 + n_nodes + n_triangles]
        cls.triangles = numpy.array([line.split()[1:] for line in rows], dtype=int)
        assert len(cls.names) == 3 and n_triangles > 1000

    def check(self, points, triangles, tolerance=1e-9):
        self.assertEqual(len(points), len(self.points))
        self.assertEqual(len(triangles), len(self.triangles))
        whole = area(self.points, self.triangles)
        self.assertAlmostEqual(area(points.astype(float), triangles), whole, delta=tolerance * whole)

    def test_numbers_of_groups_come_through(self):
        for suffix, key in NUMBERS.items():
            with self.subTest(suffix):
                mesh = meshio.read(export(suffix))
                self.check(mesh.points, mesh.cells_dict["triangle"], 1e-6)
                self.assertEqual(collections.Counter(numpy.concatenate(mesh.cell_data[key]).tolist()), self.groups)

    def test_off_is_read_as_it_was_written(self):
        mesh = meshio.read(export("off"))
        self.check(mesh.points, mesh.cells_dict["triangle"])

    def test_su2_has_elements_and_a_marker_for_each_group(self):
        path = export("su2")
        mesh = meshio.read(path)
        tags = numpy.concatenate(mesh.cell_data["su2:tag"])
        triangles = numpy.concatenate([c.data for c in mesh.cells])
        self.check(mesh.points, triangles[tags == 0])
        self.assertEqual(collections.Counter(tags[tags > 0].tolist()), self.groups)
        markers = [line.split("= ")[1] for line in path.read_text().split("\n") if line.startswith("MARKER_TAG")]
        self.assertEqual(markers, self.names)

    def test_mapbc_names_every_group_with_its_boundary_condition(self):
        path = export("lb8.ugrid")
        lines = (path.parent / "mesh.mapbc").read_text().split("\n")
        self.assertEqual(lines[0], str(len(self.names)))
        expected = [[str(i + 1), "4000", n] for i, n in enumerate(self.names)]
        self.assertEqual([line.split() for line in lines[1:-1]], expected)

    def test_quadrilaterals_cover_the_rows_of_a_stretched_mesh(self):
        run("st-import", MODELS / "wing_with_flap.step", "-o", WORK / "wing.hdf")
        run("st-raster", WORK / "wing.hdf", "-o", WORK / "wing_raster.hdf", "--max-aspect", 8)
        run("st-prolong", WORK / "wing_raster.hdf", "-o", WORK / "wing_sizing.hdf")
        run("st-mesh", WORK / "wing.hdf", WORK / "wing_sizing.hdf", "-o", WORK / "wing_patches.hdf")
        run("st-merge", WORK / "wing_patches.hdf", "-o", WORK / "wing_mesh.hdf")
        run("st-export", WORK / "wing_mesh.hdf", "-o", WORK / "wing.off")
        reference = meshio.read(WORK / "wing.off")
        n_triangles = len(reference.cells_dict["triangle"])
        whole = area(reference.points, reference.cells_dict["triangle"])
        for suffix in ("ugrid", "lb8.ugrid", "su2", "mesh", "msh"):
            with self.subTest(suffix):
                path = WORK / f"wing.{suffix}"
                run("st-export", WORK / "wing_mesh.hdf", "-o", path, "--quads")
                mesh = meshio.read(path)
                tags = mesh.cell_data.get("su2:tag", [numpy.zeros(len(c.data)) for c in mesh.cells])
                cells = [(c.type, c.data[tag == 0]) for c, tag in zip(mesh.cells, tags)]  # > 0: a marker's
                triangles, quads = (numpy.concatenate([data for kind, data in cells if kind == wanted])
                                    for wanted in ("triangle", "quad"))
                self.assertEqual(len(triangles) + 2 * len(quads), n_triangles)
                self.assertGreater(2 * len(quads), 0.3 * n_triangles)
                halves = numpy.concatenate([triangles, quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
                self.assertAlmostEqual(area(mesh.points, halves), whole, delta=1e-3 * whole)

    def test_tetgen_takes_both_of_its_formats(self):
        if not shutil.which("tetgen"):
            self.skipTest("SKIPPED: no tetgen; install Debian's package")
        for suffix in ("smesh", "poly"):
            with self.subTest(suffix):
                done = subprocess.run(["tetgen", "-pYF", export(suffix)], capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                head = (WORK / "mesh.1.ele").read_text().split("\n")[0]
                self.assertGreater(int(head.split()[0]), len(self.triangles))


if __name__ == "__main__":
    unittest.main()
