#!/usr/bin/python3
"""read_samples.py WRITE_SAMPLES FORMAT: writes the sample mesh and reads it with VTK; the expected values are those of
tests/unit/io/sample_artifacts.h."""
import subprocess
import sys
import tempfile

try:
    from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
    from vtkmodules.vtkIOHDF import vtkHDFReader
    from vtkmodules.vtkIOPLY import vtkPLYReader
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
except ImportError as error:
    print(f"SKIPPED: VTK's python modules are missing (Debian: python3-vtk9): {error}")
    sys.exit(77)

POINTS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0.1, 0.2, 1)]
TRIANGLES = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]
CELL_DATA = {"face": [1, 2, 3, 4], "group": [1, 1, 2, 2], "part": [0, 1, 2, 0], "group_table": [2, 3, 0, 1]}
POINT_DATA = {"entity_dim": [0, 0, 1, 2], "entity_id": [1, 2, 5, 4], "size": [1, 1.5, 1, 2], "edge_group": [1, 1, 1, 0],
              "edge_group_table": [0, 0, 0, 0], "vertex_group": [0, 1, 0, 0]}
FIELD_DATA = {"face_name": ["bottom", "", "Flügel", "a b"], "group_name": ["body", "wing"],
              "part_name": ["Träger/bolt#1", "Träger/bolt#2"], "group_table_name": ["hot", "cold", "Öl"],
              "edge_group_name": ["te"], "edge_group_table_name": ["root"], "vertex_group_name": ["tip"]}
# In VTU each name is an array: the numbers of what has it.
VTU_NAMES = {"face:bottom": [1], "face:Flügel": [3], "face:a b": [4], "group:body": [1], "group:wing": [2],
             "part:Träger/bolt#2": [2],
             "group_table:Öl": [3], "edge_group:te": [1], "edge_group_table:root": [1], "vertex_group:tip": [1]}
READERS = {"hdf": vtkHDFReader, "vtu": vtkXMLUnstructuredGridReader, "stl": vtkSTLReader, "obj": vtkOBJReader,
           "ply": vtkPLYReader}


def read(path, kind):
    reader = READERS[kind]()
    reader.SetFileName(path)
    if kind in ("hdf", "vtu", "ply"):
        assert reader.CanReadFile(path), "the reader does not take the file"
    complaints = []
    reader.AddObserver("ErrorEvent", lambda *_: complaints.append("error"))
    reader.AddObserver("WarningEvent", lambda *_: complaints.append("warning"))
    reader.Update()
    assert not complaints, complaints
    return reader.GetOutput()


def corners(mesh):
    """Coordinates of the corners of each cell: STL has no node numbers."""
    cells = []
    for c in range(mesh.GetNumberOfCells()):
        if mesh.GetCellType(c) in (1, 3):  # points and lines of groups of vertices and edges
            continue
        assert mesh.GetCellType(c) == 5, "no triangle"
        ids = mesh.GetCell(c).GetPointIds()
        cells.append([mesh.GetPoint(ids.GetId(k)) for k in range(3)])
    return cells


def values(data, name):
    array = data.GetAbstractArray(name)
    assert array is not None, f"array {name} is missing"
    return [array.GetValue(i) for i in range(array.GetNumberOfValues())]


def check_geometry(mesh):
    found = corners(mesh)
    assert len(found) == len(TRIANGLES), len(found)
    for cell, triangle in zip(found, TRIANGLES):
        for point, node in zip(cell, triangle):
            assert all(abs(a - b) < 1e-6 for a, b in zip(point, POINTS[node])), (point, POINTS[node])


def check_data(data, expected):
    for name, numbers in expected.items():
        assert values(data, name) == numbers, (name, values(data, name))


def main():
    program, kind = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, folder], check=True)
        mesh = read(f"{folder}/mesh.{kind}", kind)
        check_geometry(mesh)
        if kind in ("hdf", "vtu"):
            assert [mesh.GetPoint(i) for i in range(mesh.GetNumberOfPoints())] == POINTS
            check_data(mesh.GetCellData(), CELL_DATA)
            check_data(mesh.GetPointData(), POINT_DATA)
            check_data(mesh.GetFieldData(), FIELD_DATA if kind == "hdf" else VTU_NAMES)
        if kind == "obj":
            text = open(f"{folder}/mesh.obj").read()
            assert "g edge_group_1_te\nl 1 3\n" in text
            assert "\ng body\n# face 1 bottom\nf 1 3 2\n# face 2 \n" in text, text
            assert "\ng wing\n# face 3 Flügel\n" in text, text
        if kind == "ply":
            header = open(f"{folder}/mesh.ply", "rb").read().split(b"end_header")[0].decode()
            for line in ("comment group 2 wing", "comment face 3 Flügel", "comment part 1 Träger/bolt#1",
                         "property int group_table", "property int edge_group",
                         "comment edge_group 1 te"):
                assert line in header, header
        if kind == "stl":  # in the order of groups, which is that of the triangles here
            check_geometry(read(f"{folder}/mesh.ascii.stl", kind))
            assert [line.split()[1] for line in open(f"{folder}/mesh.ascii.stl")
                    if line.startswith("solid")] == ["body", "wing"]
    print(f"{kind}: read as written")


main()
