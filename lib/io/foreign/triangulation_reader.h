// Reading triangulations of other programs.
#pragma once

#include <string>

#include "mesh/surface_mesh.h"

namespace st {

/// The triangles of a file, recognised by content: STL (ASCII or binary; equal points become one node), OBJ and PLY
/// (polygons become triangles), Gmsh MSH 2.2 and 4.1 (text or binary), VTU (ascii, base64, appended; uncompressed or
/// zlib), FLITE .fro, VTKHDF, and a mesh artifact. But for the latter, for several solids of an STL file and groups of
/// OBJ, there are no names. There are no groups, nodes and triangles keep the file's order, faces are the file's
/// surfaces in the order of their numbers (else connected parts), and node_size is what a VTU or VTKHDF file has as
/// point data "size", else 0. Nodes without a triangle stay; triangles that name a node twice are left out; other cells
/// than triangles are ignored where they are points, lines or volumes. Throws Error(kInput) for a missing file, another
/// kind of file, one that is cut off, coordinates that are not finite, nodes that do not exist, and quadrangles or
/// curved triangles.
SurfaceMesh read_triangulation(const std::string& path);

/// Must `path` be read by read_triangulation() and not by read_mesh()? True for any file that is not HDF5, and for HDF5
/// of other programs with a group /VTKHDF; false for what is missing, empty or a folder.
bool is_foreign_mesh(const std::string& path);

/// "an STL mesh", "a Gmsh mesh" ... by the first bytes of the file; empty for anything else, HDF5 included.
std::string triangulation_format(const std::string& path);

}  // namespace st
