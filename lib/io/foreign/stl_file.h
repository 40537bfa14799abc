// Reading STL.
#pragma once

#include <string>

#include "mesh/surface_mesh.h"

namespace st {

/// The triangles of an STL file, binary or ASCII (told apart by content). Several solids are the faces and
/// name them; else each connected part is a face without a name.
/// Equal points become one node, numbered in the order of the file; triangles that then name a node twice are left out.
/// Throws Error(kInput) for anything else.
SurfaceMesh read_stl(const std::string& path);

}  // namespace st
