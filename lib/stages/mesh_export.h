// Exports of a mesh, with a word on what they leave out.
#pragma once

#include <string>

#include "mesh/quad_pairs.h"

namespace st {

/// export_mesh(), and a warning when the format cannot hold the mesh's groups of edges and vertices. Local.
void export_and_warn(const std::string& path, const SurfaceMesh& mesh, const QuadPairs& elements);

}  // namespace st
