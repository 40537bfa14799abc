// Which facets have a node.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/facet/facet_mesh.h"

namespace st {

/// Facets of each node, ascending, when it was made. Plain arrays: 12 bytes per facet and 4 per node.
class FacetsOfNodes {
 public:
  FacetsOfNodes() = default;
  /// Nodes lie in [0, n_nodes).
  FacetsOfNodes(std::span<const Corners> corners, std::size_t n_nodes);
  std::span<const std::int32_t> of(std::int32_t node) const {
    return std::span(facet_).subspan(offsets_[node], offsets_[node + 1] - offsets_[node]);
  }

 private:
  std::vector<std::int32_t> offsets_, facet_;
};

}  // namespace st
