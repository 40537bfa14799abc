// What of a mesh is to be made again where sizes became smaller.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mesh/edge_mesh.h"
#include "meshing/face/refinements.h"
#include "meshing/topology/mesh_topology.h"

namespace st {

/// 1: a refinement reaches it, or it has nodes in common with what one reaches.
struct DirtyParts {
  std::vector<char> edge;  ///< [n_edges]
  std::vector<char> face;  ///< [n_faces]
};

/// Edges by their present nodes, faces by their boxes; both long edges of a closed strip together, each edge of
/// `followers` together with its leader (the second), and all faces of such edges. Local.
DirtyParts find_dirty_parts(const MeshTopology& topology, const EdgeMesh& edges,
                            std::span<const Refinement> refinements,
                            std::span<const std::pair<EdgeId, EdgeId>> followers);

/// Those of `ids` that are chosen, in their order.
std::vector<std::int32_t> chosen_of(const std::vector<std::int32_t>& ids, const std::vector<char>& is_chosen);

}  // namespace st
