"""Meshes in the formats of other programs, written from a VTU that st-export made."""
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader


class Mesh:
    """Nodes x (n, 3), triangles (n, 3) from 0, surface number of each triangle."""

    def __init__(self, vtu):
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(vtu))
        reader.Update()
        grid = reader.GetOutput()
        self.x = vtk_to_numpy(grid.GetPoints().GetData()).copy()
        self.triangles = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 3).copy()
        self.surface = vtk_to_numpy(grid.GetCellData().GetArray("face")).copy()

    def nodes(self):
        return [f"{i + 1} {x:.17g} {y:.17g} {z:.17g}\n" for i, (x, y, z) in enumerate(self.x)]

    def write_fro(self, path):
        head = [f"{len(self.triangles)} {len(self.x)} 1 0 0 {self.surface.max()} 0 0\n"]
        rows = [f"{i + 1} {a + 1} {b + 1} {c + 1} {s}\n" for i,
                ((a, b, c), s) in enumerate(zip(self.triangles, self.surface))]
        path.write_text("".join(head + self.nodes() + rows))

    def write_msh(self, path):
        rows = [f"{i + 1} 2 2 0 {s} {a + 1} {b + 1} {c + 1}\n" for i,
                ((a, b, c), s) in enumerate(zip(self.triangles, self.surface))]
        parts = ["$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", f"$Nodes\n{len(self.x)}\n", *self.nodes(),
                 f"$EndNodes\n$Elements\n{len(rows)}\n", *rows, "$EndElements\n"]
        path.write_text("".join(parts))

    def write_stl(self, path):
        rows = []
        for t in self.triangles:
            corners = "".join("vertex {:.17g} {:.17g} {:.17g}\n".format(*self.x[n]) for n in t)
            rows.append(f"facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
        path.write_text("solid mesh\n" + "".join(rows) + "endsolid mesh\n")

    def write_vtu(self, path, sizes):
        """Ascii, with point data `size`."""
        def array(kind, name, values, components=1):
            text = " ".join(map(repr, values.ravel().tolist()))
            return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii">'
                    f'{text}</DataArray>\n')

        n = len(self.triangles)
        cells = (array("Int64", "connectivity", self.triangles) + array("Int64", "offsets", 3 * np.arange(1, n + 1)) +
                 array("UInt8", "types", np.full(n, 5)))
        path.write_text('<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="0.1" '
                        'byte_order="LittleEndian">\n<UnstructuredGrid>\n'
                        f'<Piece NumberOfPoints="{len(self.x)}" NumberOfCells="{n}">\n<Points>\n'
                        f'{array("Float64", "Points", self.x, 3)}</Points>\n'
                        f'<Cells>\n{cells}</Cells>\n<PointData>\n'
                        f'{array("Float64", "size", np.asarray(sizes))}</PointData>\n</Piece>\n</UnstructuredGrid>\n'
                        f'</VTKFile>\n')
