// Edges inside a patch: what is wrong with them is told without the patches around it.
#pragma once

#include <cstdint>

#include "mesh/surface_mesh.h"

namespace st {

/// Uses of mesh edges with a node inside the patch.
struct InnerEdges {
  std::int64_t n_open = 0, n_nonmanifold = 0, n_misoriented = 0;
  bool is_balanced = true;  // as many sides run one way as the other, along each
};

/// Of the patch's triangles but those with a repeated node. On all threads where the patch is large.
InnerEdges count_inner_edges(const FacePatch& patch);

}  // namespace st
