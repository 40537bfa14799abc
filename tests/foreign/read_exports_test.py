"""Exports read by programs of others: counts, area and triangles of each group are those of the mesh.

usage: read_exports_test.py [CLASS]
environment: ST_BIN, ST_MODELS, ST_WORK; ST_READ_CGNS, ST_WRITE_MANY_GROUPS: programs; ST_FOREIGN_RUN: a folder with
geometry.hdf and mesh.hdf to judge in place of the test model, for the class Exports alone
"""
import collections
import json
import os
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

try:
    import h5py
    import meshio
    import numpy
except ImportError as e:
    print(f"SKIPPED: {e}; install python3-meshio and python3-h5py, and run with /usr/bin/python3")
    sys.exit(77)

BIN, MODELS = Path(os.environ["ST_BIN"]), Path(os.environ["ST_MODELS"])
RUN = os.environ.get("ST_FOREIGN_RUN")
WORK = Path(os.environ["ST_WORK"]) / ("foreign_run" if RUN else "foreign")
of_the_test_model = unittest.skipIf(RUN, "its figures are those of the test model")
READ_CGNS = os.environ.get("ST_READ_CGNS")
NUMBERS = {"ugrid": "ugrid:ref", "lb8.ugrid": "ugrid:ref", "b8.ugrid": "ugrid:ref", "bdf": "nastran:ref",
           "nas": "nastran:ref", "mesh": "medit:ref", "meshb": "medit:ref", "ply": "group", "vtu": "group"}
GMSH_READS = ("msh", "msh2", "binary.msh", "binary.msh2", "mesh", "stl", "ascii.stl", "ply")
MSH_KINDS = [("msh", ()), ("msh", ("--binary",)), ("msh2", ()), ("msh2", ("--binary",))]


def run(tool, *arguments):
    done = subprocess.run([BIN / tool, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done


def export(suffix, *options, mesh="mesh"):
    path = WORK / f"{mesh}.{suffix}"
    run("st-export", WORK / f"{mesh}.hdf", "-o", path, "-q", *options)
    return path


def through_gmsh(path, *options):
    """What gmsh makes of a file, by way of its own format. By content, as its suffix is not always gmsh's."""
    copy, out = path.with_name("gmsh_in." + path.suffix[1:].replace("msh2", "msh")), path.with_name("gmsh_out.msh")
    shutil.copy(path, copy)
    out.unlink(missing_ok=True)
    command = ["gmsh", copy, "-0", "-format", "msh41", *options, "-o", out]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0 and "Error" not in done.stdout, done.stdout
    return meshio.read(out)


def read_cgns(path):
    """By the CGNS library."""
    done = subprocess.run([READ_CGNS, path], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def triangles_of(mesh, kind="triangle"):
    return numpy.concatenate([c.data for c in mesh.cells if c.type == kind])


def counts(mesh, key, kind="triangle"):
    """Elements of each number."""
    of_kind = [numpy.ravel(d) for c, d in zip(mesh.cells, mesh.cell_data[key]) if c.type == kind]
    return collections.Counter(numpy.concatenate(of_kind).tolist())


def area(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return 0.5 * numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1).sum()


class Exports(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        WORK.mkdir(parents=True)
        if RUN:
            for name in ("geometry.hdf", "mesh.hdf"):
                shutil.copy(Path(RUN) / name, WORK)
        else:
            run("st-import", MODELS / "assembly.step", "-o", WORK / "geometry.hdf", "-q")
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
        with h5py.File(WORK / "geometry.hdf") as file:
            unit = file["/st"].attrs["unit"]
            cls.unit = unit.decode() if isinstance(unit, bytes) else str(unit)
        assert len(cls.names) >= 3 and n_triangles > 1000

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

    def test_names_of_groups_come_through_gmshs_own_format(self):
        for suffix, options in MSH_KINDS:
            with self.subTest(suffix, options=options):
                mesh = meshio.read(export(suffix, *options), file_format="gmsh")
                self.check(mesh.points, triangles_of(mesh))
                self.assertEqual(counts(mesh, "gmsh:physical"), self.groups)
                self.assertEqual({n: v[0] for n, v in mesh.field_data.items() if ":" not in n},
                                 {n: i + 1 for i, n in enumerate(self.names)})

    def test_gmsh_reads_what_it_should(self):
        if not shutil.which("gmsh"):
            self.skipTest("SKIPPED: no gmsh; install Debian's package")
        for suffix in GMSH_READS:
            with self.subTest(suffix):
                mesh = through_gmsh(export(suffix))
                self.check(mesh.points, triangles_of(mesh), 1e-5)
                if "msh" in suffix:
                    self.assertEqual(counts(mesh, "gmsh:physical"), self.groups)

    def test_meshio_reads_obj_group_by_group(self):
        path = export("obj")
        mesh = meshio.read(path)
        self.check(mesh.points, triangles_of(mesh))
        names = [line[2:] for line in path.read_text().split("\n") if line.startswith("g ")]
        self.assertEqual(names, self.names)
        self.assertEqual(list(counts(mesh, "obj:group_ids").values()), list(self.groups.values()))

    def test_vtk_reads_each_format_it_has_a_reader_for(self):
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
        from vtkmodules.vtkIOPLY import vtkPLYReader
        readers = {"stl": vtkSTLReader, "ascii.stl": vtkSTLReader, "obj": vtkOBJReader, "ply": vtkPLYReader,
                   "binary.ply": vtkPLYReader}
        for suffix, kind in readers.items():
            with self.subTest(suffix):
                reader = kind()
                reader.SetFileName(str(export(suffix)))
                reader.Update()
                out = reader.GetOutput()
                triangles = vtk_to_numpy(out.GetPolys().GetConnectivityArray()).reshape(-1, 3)
                self.check(vtk_to_numpy(out.GetPoints().GetData()), triangles, 1e-5)

    def test_a_path_chosen_by_format_is_written_in_it(self):
        path = export("dat", "--format", "msh2")
        self.assertEqual(path.read_bytes(), export("msh2").read_bytes())

    def test_units_scale_coordinates(self):
        unit, factor = ("m", 1e-6) if self.unit == "mm" else ("mm", 1e6)
        mesh = meshio.read(export("off", "--unit", unit))
        whole = factor * area(self.points, self.triangles)
        self.assertAlmostEqual(area(mesh.points, triangles_of(mesh)), whole, delta=1e-9 * whole)

    @unittest.skipUnless(READ_CGNS, "SKIPPED: no libcgns-dev")
    def test_the_cgns_library_reads_families_sections_and_the_unit(self):
        path = export("cgns")
        found = read_cgns(path)
        self.assertEqual((found["nodes"], found["elements"]), (len(self.points), len(self.triangles)))
        self.assertEqual(found["unit"], {"mm": "Millimeter", "m": "Meter"}[self.unit])
        kinds = {"farfield": "BCFarfield", "symmetry": "BCSymmetryPlane"}
        self.assertEqual(found["families"], {n: kinds.get(n, "BCWall") for n in self.names})
        self.assertEqual({s["name"]: s["last"] - s["first"] + 1 for s in found["sections"]},
                         {n: self.groups[i + 1] for i, n in enumerate(self.names)})
        self.assertEqual({b["family"]: (b["first"], b["last"]) for b in found["boundaries"]},
                         {s["name"]: (s["first"], s["last"]) for s in found["sections"]})
        whole = area(self.points, self.triangles)
        self.assertAlmostEqual(sum(s["area"] for s in found["sections"]), whole, delta=1e-9 * whole)
        self.assertEqual(path.read_bytes(), export("cgns").read_bytes())  # equal content, equal bytes
        self.assertEqual(read_cgns(export("cgns", "--unit", "m"))["unit"], "Meter")
        if shutil.which("cgnscheck"):
            done = subprocess.run(["cgnscheck", path], capture_output=True, text=True)
            self.assertEqual([line for line in done.stdout.split("\n") if "WARNING" in line or "ERROR" in line], [])

    def test_vtk_reads_cgns(self):
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkIOCGNSReader import vtkCGNSReader
        reader = vtkCGNSReader()
        reader.SetFileName(str(export("cgns")))
        reader.Update()
        grid = reader.GetOutput().GetBlock(0).GetBlock(0)
        triangles = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 3)
        self.check(vtk_to_numpy(grid.GetPoints().GetData()), triangles)

    def test_elements_of_second_order_follow_the_cad(self):
        chords = area(self.points, self.triangles)
        nodes = ("triangle6", 6)
        for suffix, options in [*MSH_KINDS, ("vtu", ()), ("nas", ())]:
            with self.subTest(suffix, options=options):
                path = export(suffix, "--quadratic", "--geometry", WORK / "geometry.hdf", *options)
                mesh = meshio.read(path, file_format="gmsh") if "msh" in suffix else meshio.read(path)
                elements = triangles_of(mesh, nodes[0])
                self.assertEqual(elements.shape, (len(self.triangles), nodes[1]))
                n_sides = len(numpy.unique(numpy.sort(self.sides(), axis=1), axis=0))
                self.assertEqual(len(mesh.points), len(self.points) + n_sides)
                for k, (low, high) in enumerate([(0, 1), (1, 2), (2, 0)]):  # node 3 lies between the first two ...
                    ends = mesh.points[elements[:, [low, high]]]
                    rise = numpy.linalg.norm(mesh.points[elements[:, 3 + k]] - ends.mean(axis=1), axis=1)
                    self.assertLess((rise / numpy.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)).max(), 0.34)
                quarters = numpy.concatenate([elements[:, k] for k in ([0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5])])
                # the exact area of box and pins: chords err by the square of their length, so a quarter is left
                exact = self.exact_area()
                self.assertLess(abs(exact - area(mesh.points, quarters)), 0.3 * abs(exact - chords))
        if READ_CGNS:
            found = read_cgns(export("cgns", "--quadratic", "--geometry", WORK / "geometry.hdf"))
            self.assertEqual({s["type"] for s in found["sections"]}, {"TRI_6"})

    def sides(self):
        return numpy.concatenate([self.triangles[:, [0, 1]], self.triangles[:, [1, 2]], self.triangles[:, [2, 0]]])

    @staticmethod
    def exact_area():
        with h5py.File(WORK / "geometry.hdf") as file:
            return float(file["/st/face/area"][...].sum())

    def test_parameters_and_lines_of_all_edges_come_with_the_geometry(self):
        if not shutil.which("gmsh"):
            self.skipTest("SKIPPED: no gmsh; install Debian's package")
        path = export("msh", "--parametric", "--geometry", WORK / "geometry.hdf")
        mesh = through_gmsh(path, "-save_all", "-format", "msh22")
        self.check(mesh.points, triangles_of(mesh))
        lines = triangles_of(mesh, "line")
        ends = {tuple(sorted(pair)) for pair in lines.tolist()}
        self.assertEqual(len(ends), len(lines))
        self.assertGreater(len(lines), 300)
        corners = triangles_of(mesh)
        sides = numpy.concatenate([corners[:, k] for k in ([0, 1], [1, 2], [2, 0])])
        self.assertLessEqual(ends, {tuple(sorted(s)) for s in sides.tolist()})
        medit = meshio.read(export("meshb", "--parametric", "--geometry", WORK / "geometry.hdf"))
        self.assertEqual(len(triangles_of(medit, "line")), len(lines))
        self.check(medit.points, triangles_of(medit))

    @of_the_test_model
    def test_vtk_reads_a_block_for_each_group_with_what_was_measured(self):
        from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet
        from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataReader
        reader = vtkXMLMultiBlockDataReader()
        reader.SetFileName(str(export("vtm", "--geometry", WORK / "geometry.hdf")))
        reader.Update()
        out = reader.GetOutput()
        blocks = {out.GetMetaData(i).Get(vtkCompositeDataSet.NAME()): out.GetBlock(i)
                  for i in range(out.GetNumberOfBlocks())}
        self.assertEqual({name: b.GetNumberOfCells() for name, b in blocks.items()},
                         {name: self.groups[i + 1] for i, name in enumerate(self.names)})
        ranges = {name: [b.GetCellData().GetArray(v).GetRange() for v in ("quality", "size_ratio", "deviation")]
                  for name, b in blocks.items()}
        for quality, ratio, _ in ranges.values():
            self.assertTrue(0.3 < quality[0] <= quality[1] <= 1 and 0.3 < ratio[0] <= ratio[1] < 2, ranges)
        self.assertEqual(ranges["block"][2], (0, 0))  # planes
        self.assertTrue(1e-3 < ranges["pin_mantle"][2][1] < 0.1, ranges)  # a cylinder

    @of_the_test_model
    def test_the_cad_is_shown_with_its_edges(self):
        run("st-export", WORK / "geometry.hdf", "-o", WORK / "cad.vtu", "-q")
        mesh = meshio.read(WORK / "cad.vtu")
        self.assertEqual(counts(mesh, "dim").keys() | counts(mesh, "dim", "line").keys(), {1, 2})
        with h5py.File(WORK / "geometry.hdf") as file:
            faces = file["/st/face/area"][...]
            lengths, is_pole = file["/st/edge/length"][...], file["/st/edge/is_degenerate"][...]
        self.assertEqual(set(counts(mesh, "id")), set(range(1, len(faces) + 1)))
        self.assertEqual(set(counts(mesh, "id", "line")), {i + 1 for i, pole in enumerate(is_pole) if not pole})
        self.assertAlmostEqual(area(mesh.points, triangles_of(mesh)), faces.sum(), delta=0.01 * faces.sum())
        ends = mesh.points[triangles_of(mesh, "line")]
        found = numpy.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum()
        self.assertAlmostEqual(found, lengths.sum(), delta=0.01 * lengths.sum())
        self.assertEqual(mesh.field_data["group:pin"].tolist(), [3])

    def test_split_groups_makes_a_file_for_each(self):
        run("st-export", WORK / "mesh.hdf", "-o", WORK / "part.stl", "--split-groups", "-q")
        sizes = [len(triangles_of(meshio.read(WORK / f"part_{name}.stl"))) for name in self.names]
        self.assertEqual(sizes, [self.groups[i + 1] for i in range(len(self.names))])

    @of_the_test_model
    def test_losses_are_said_on_one_line(self):
        said = {"off": "groups (3), parts (3)", "meshb": "names of groups (3), parts (3)", "msh": None,
                "su2": "parts (3)"}
        for suffix, lost in said.items():
            path = WORK / f"mesh.{suffix}"
            done = run("st-export", WORK / "mesh.hdf", "-o", path)
            self.assertEqual(done.stderr, f"warning: {path}: this format has no room for {lost}\n" if lost else "")

    def test_feature_lines_are_written_as_openfoam_reads_them(self):
        text = export("eMesh").read_text()
        self.assertIn("class featureEdgeMesh;", text)
        lists = re.findall(r"\n(\d+)\n\(\n(.*?)\n\)\n", text, re.S)
        self.assertEqual([int(n) for n, _ in lists], [len(rows.split("\n")) for _, rows in lists])
        points, edges = ([row.strip("()").split() for row in rows.split("\n")] for _, rows in lists)
        self.assertEqual(set(numpy.ravel(edges).astype(int)), set(range(len(points))))
        self.assertLess(export("eMesh", "--feature-angle", 179).read_text().count("\n"), text.count("\n"))

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
        kinds = {"farfield": "5000", "symmetry": "6662"}  # symmetry across y
        expected = [[str(i + 1), kinds.get(n, "4000"), n] for i, n in enumerate(self.names)]
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

    def test_tetgen_takes_its_formats_and_others(self):
        if not shutil.which("tetgen"):
            self.skipTest("SKIPPED: no tetgen; install Debian's package")
        for suffix in ("smesh", "poly", "ply", "off", "mesh"):
            with self.subTest(suffix):
                for old in WORK.glob("mesh.1.*"):
                    old.unlink()
                done = subprocess.run(["tetgen", "-pYF", export(suffix)], capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                head = (WORK / "mesh.1.ele").read_text().split("\n")[0]
                self.assertGreater(int(head.split()[0]), len(self.triangles))


class Values(unittest.TestCase):
    """Values at nodes that st-remesh carried: `place` is where a node is, `p` a function of that."""

    @classmethod
    def setUpClass(cls):
        WORK.mkdir(parents=True, exist_ok=True)
        run("st-import", MODELS / "box.step", "-o", WORK / "box.hdf", "-q")
        run("st-raster", WORK / "box.hdf", "-o", WORK / "raster.hdf", "-q")
        for scale in (1, 0.8):
            run("st-prolong", WORK / "raster.hdf", "-o", WORK / f"sizing{scale}.hdf", "-q", "--scale", scale)
        run("st-mesh", WORK / "box.hdf", WORK / "sizing1.hdf", "-o", WORK / "patches.hdf", "-q")
        run("st-merge", WORK / "patches.hdf", "-o", WORK / "plain.hdf", "-q")
        points = meshio.read(export("off", mesh="plain")).points
        arrays = {"place": points, "p": cls.p(points)}
        text = "".join(f'<DataArray type="Float64" Name="{name}" NumberOfComponents="{a[:1].size}" format="ascii">'
                       f'{" ".join(map(repr, a.ravel().tolist()))}</DataArray>' for name, a in arrays.items())
        (WORK / "field.vtu").write_text(
            f'<VTKFile type="UnstructuredGrid"><PointData>{text}</PointData></VTKFile>')
        run("st-remesh", WORK / "plain.hdf", WORK / "box.hdf", WORK / "sizing0.8.hdf", "--merged", WORK / "values.hdf",
            "-q", "--interpolate", f"{WORK / 'field.vtu'}:place,p")

    @staticmethod
    def p(points):
        return points @ numpy.array([1.0, 0.1, -2.0])

    def check(self, points, place, p):
        size = numpy.abs(points).max()
        self.assertGreater(len(points), 20)
        self.assertLess(numpy.abs(place - points).max(), 1e-9 * size)
        self.assertLess(numpy.abs(p - self.p(points)).max(), 1e-8 * size)

    def test_meshio_and_gmsh_read_the_views(self):
        for suffix, options in MSH_KINDS:
            with self.subTest(suffix, options=options):
                path = export(suffix, *options, mesh="values")
                mesh = meshio.read(path, file_format="gmsh")
                self.check(mesh.points, mesh.point_data["place"], mesh.point_data["p"].ravel())
                copy = path.with_name("gmsh_in.msh")
                shutil.copy(path, copy)
                script = path.with_name("count.geo")
                script.write_text(f'Merge "{copy}"; Printf("views %g", PostProcessing.NbViews);\n')
                done = subprocess.run(["gmsh", script, "-"], capture_output=True, text=True)
                self.assertIn("views 2", done.stdout)

    def test_vtk_reads_the_solution_of_cgns(self):
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkIOCGNSReader import vtkCGNSReader
        path = export("cgns", mesh="values")
        reader = vtkCGNSReader()
        reader.SetFileName(str(path))
        reader.UpdateInformation()
        reader.EnableAllPointArrays()
        reader.Update()
        grid = reader.GetOutput().GetBlock(0).GetBlock(0)
        data = grid.GetPointData()
        self.check(vtk_to_numpy(grid.GetPoints().GetData()), vtk_to_numpy(data.GetArray("place")),
                   vtk_to_numpy(data.GetArray("p")))
        if shutil.which("cgnscheck"):
            done = subprocess.run(["cgnscheck", path], capture_output=True, text=True)
            said = {line for line in done.stdout.split("\n") if "WARNING" in line or "ERROR" in line}
            self.assertLessEqual(said, {"WARNING:not a CGNS data-name identifier"})  # names are the user's

    def test_a_table_has_them_with_their_places(self):
        table = numpy.genfromtxt(export("csv", mesh="values"), delimiter=",", names=True)
        points, places = ([table[name] for name in names] for names in ("xyz", ("place_1", "place_2", "place_3")))
        self.check(numpy.transpose(points), numpy.transpose(places), table["p"])
        self.assertEqual(table["node"].tolist(), list(range(len(table))))


class Pairs(unittest.TestCase):
    """A passage whose sides are images of one another, 33 mm apart."""
    STEP = 0.033

    @classmethod
    def setUpClass(cls):
        WORK.mkdir(parents=True, exist_ok=True)
        run("make_model", "cascade", WORK / "cascade.step")
        run("st-import", WORK / "cascade.step", "-o", WORK / "pairs_geometry.hdf", "-q")
        run("st-raster", WORK / "pairs_geometry.hdf", "-o", WORK / "raster.hdf", "-q")
        run("st-prolong", WORK / "raster.hdf", "-o", WORK / "sizing.hdf", "-q", "--scale", "3")
        run("st-mesh", WORK / "pairs_geometry.hdf", WORK / "sizing.hdf", "-o", WORK / "patches.hdf", "-q", "--pairs",
            "auto")
        run("st-merge", WORK / "patches.hdf", "-o", WORK / "pairs.hdf", "-q")

    @unittest.skipUnless(READ_CGNS, "SKIPPED: no libcgns-dev")
    def test_the_cgns_library_finds_each_node_on_the_other_side(self):
        for options, unit in [((), 1), (("--unit", "mm"), 1000),
                              (("--quadratic", "--geometry", WORK / "pairs_geometry.hdf"), 1)]:
            with self.subTest(options):
                path = export("cgns", *options, mesh="pairs")
                links = read_cgns(path)["connections"]
                self.assertEqual(len(links), 4)  # inlet and outlet are images, too
                for link in links:
                    self.assertEqual((link["type"], link["location"]), ("Abutting1to1", "Vertex"))
                    self.assertGreater(link["nodes"], 10)
                    self.assertEqual(link["nodes"], link["donors"])
                    self.assertLess(link["apart"], 1e-5 * self.STEP * unit)
                if shutil.which("cgnscheck"):
                    done = subprocess.run(["cgnscheck", path], capture_output=True, text=True)
                    self.assertEqual([line for line in done.stdout.split("\n") if "WARNING" in line or "ERROR" in line],
                                     [])

    def test_su2s_line_takes_one_marker_to_the_other(self):
        for options, unit in [((), 1), (("--unit", "mm"), 1000)]:
            text = export("su2", *options, mesh="pairs").read_text()
            fields = re.match(r"% MARKER_PERIODIC= \( (.*) \)\n", text).group(1).split(", ")
            points = re.search(r"NPOIN= \d+\n(.*?)NMARK", text, re.S).group(1).split()
            points = numpy.array(points, dtype=float).reshape(-1, 4)[:, :3]
            sides = []
            for name in fields[:2]:
                marker = re.search(rf"MARKER_TAG= {name}\nMARKER_ELEMS= \d+\n([\d \n]*)", text).group(1)
                nodes = numpy.unique([line.split()[1:] for line in marker.strip().split("\n")])
                sides.append(points[nodes.astype(int)])
            self.assertEqual(fields[2:8], ["0"] * 6)
            a, b = sides[0] + numpy.array(fields[8:], dtype=float), sides[1]
            self.assertEqual(len(a), len(b))
            apart = max(numpy.linalg.norm(b - x, axis=1).min() for x in a)
            self.assertLess(apart, 1e-9 * self.STEP * unit)

    @unittest.skipUnless(shutil.which("gmsh"), "SKIPPED: no gmsh; install Debian's package")
    def test_gmsh_reads_a_side_alone(self):
        run("st-export", WORK / "pairs.hdf", "-o", WORK / "side.msh", "-q", "--split-groups")
        sides = list(WORK.glob("side_periodic_*.msh"))
        self.assertEqual(len(sides), 2)
        for side in sides:
            self.assertNotIn("$Periodic", side.read_text())
            through_gmsh(side)


class ManyGroups(unittest.TestCase):
    """500 groups, with blanks, quotes, umlauts, other scripts, and names longer than CGNS has room for."""
    N = 500

    @classmethod
    def setUpClass(cls):
        WORK.mkdir(parents=True, exist_ok=True)
        subprocess.run([os.environ["ST_WRITE_MANY_GROUPS"], WORK / "many.hdf"], check=True)
        cls.kinds = ["Flügel unten ", "wing root, 'left' ", "翼 ", "a/b ",
                     "a very long name of a group that differs late "]
        cls.names = [cls.kinds[i % 5] + str(i) for i in range(cls.N)]
        cls.numbers = {n: i + 1 for i, n in enumerate(cls.names)}
        cls.each = collections.Counter({i + 1: 2 for i in range(cls.N)})

    def test_msh_has_every_name(self):
        for suffix, options in MSH_KINDS:
            with self.subTest(suffix, options=options):
                mesh = meshio.read(export(suffix, *options, mesh="many"), file_format="gmsh")
                self.assertEqual({n: v[0] for n, v in mesh.field_data.items()}, self.numbers)
                self.assertEqual(counts(mesh, "gmsh:physical"), self.each)

    def test_gmsh_keeps_every_name(self):
        if not shutil.which("gmsh"):
            self.skipTest("SKIPPED: no gmsh; install Debian's package")
        mesh = through_gmsh(export("msh", mesh="many"))
        self.assertEqual({n: v[0] for n, v in mesh.field_data.items()}, self.numbers)
        self.assertEqual(counts(mesh, "gmsh:physical"), self.each)

    @unittest.skipUnless(READ_CGNS, "SKIPPED: no libcgns-dev")
    def test_cgns_has_a_family_for_each(self):
        found = read_cgns(export("cgns", mesh="many"))
        families = [b["family"] for b in found["boundaries"]]
        self.assertEqual(len(set(families)), self.N)
        self.assertEqual(set(found["families"]), set(families))
        for name, family in zip(self.names, families):
            self.assertLessEqual(len(family.encode()), 32)
            if len(name) < 30:
                self.assertEqual(family, name.replace("/", "_"))
        ranges = [(b["first"], b["last"]) for b in found["boundaries"]]
        self.assertEqual(ranges, [(2 * i + 1, 2 * i + 2) for i in range(self.N)])

    def test_vtu_has_every_name(self):
        mesh = meshio.read(export("vtu", mesh="many"))
        self.assertEqual({n.removeprefix("group:"): int(v[0]) for n, v in mesh.field_data.items()}, self.numbers)
        self.assertEqual(counts(mesh, "group"), self.each)

    def test_formats_of_words_have_a_word_for_each(self):
        words = [n.replace(" ", "_").replace("/", "_") for n in self.names]
        self.assertEqual(re.findall("^MARKER_TAG= (.*)$", export("su2", mesh="many").read_text(), re.M), words)
        self.assertEqual(re.findall("^g (.*)$", export("obj", mesh="many").read_text(), re.M), words)
        solids = re.findall("^solid (.*)$", export("ascii.stl", mesh="many").read_text(), re.M)
        self.assertEqual(solids, [n.replace(" ", "_") for n in self.names])
        export("b8.ugrid", mesh="many")
        self.assertEqual([line.split()[2] for line in (WORK / "many.mapbc").read_text().split("\n")[1:-1]], words)
        for suffix in ("b8.ugrid", "lb8.ugrid", "ugrid", "nas", "mesh", "meshb", "ply"):
            with self.subTest(suffix):
                self.assertEqual(counts(meshio.read(export(suffix, mesh="many")), NUMBERS[suffix]), self.each)


if __name__ == "__main__":
    unittest.main()
