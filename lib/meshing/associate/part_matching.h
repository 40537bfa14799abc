// Which connected part of a mesh is which connected part of a CAD model.
#pragma once

#include <vector>

#include "geometry/model/model.h"
#include "mesh/surface_mesh.h"

namespace st {

/// Parts of the mesh, connected by nodes, and for each vertex the one to which it belongs.
struct MatchedParts {
  std::int32_t n_parts = 1;
  std::vector<std::int32_t> node_part;    ///< [n_nodes] kNone: no triangle
  std::vector<std::int32_t> vertex_part;  ///< [n_vertices]
};

/// Parts are matched by their boxes and areas. All is one part when the mesh and the model have not as many. Touching
/// bodies are told apart by this where nothing else does. Local, n log n, quadratic in the number of parts.
MatchedParts match_parts(const SurfaceMesh& mesh, const ModelTables& tables);

}  // namespace st
