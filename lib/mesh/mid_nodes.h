// Nodes in the middle of sides, for elements of second order.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "mesh/surface_mesh.h"

namespace st {

/// One node for each side of a mesh's elements; node k of these is node n_nodes + k of the mesh.
struct MidNodes {
  std::vector<std::array<NodeId, 2>> ends;  ///< [n] lower node first; ascending
  std::vector<Vec3> xyz;                    ///< [n]
  std::vector<std::uint8_t> entity_dim;     ///< [n] EntityDim: 1 edge, 2 face
  std::vector<std::int32_t> entity;         ///< [n] 0-based id of that edge or face

  bool empty() const { return ends.empty(); }
  std::int64_t size() const { return static_cast<std::int64_t>(ends.size()); }
  /// Number, from 0, of the node between two others. Precondition: it exists.
  std::int64_t between(NodeId a, NodeId b) const {
    return std::lower_bound(ends.begin(), ends.end(), std::array{std::min(a, b), std::max(a, b)}) - ends.begin();
  }
};

}  // namespace st
