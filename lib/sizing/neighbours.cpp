#include "sizing/neighbours.h"

#include "base/error.h"

namespace st {

Neighbours::Neighbours(const OctreeView& octree) : octree_(octree) {
  const std::size_t n_nodes = octree.node_children.size() / 8;
  node_neighbours_.assign(27 * n_nodes, kOutside);
  leaf_parent_.assign(octree.leaf_keys.size(), kNone);
  if (n_nodes == 0) return;
  node_neighbours_[kOwn] = 0;
  for (std::size_t node = 0; node < n_nodes; ++node) {  // parents come before their children
    for (int o = 0; o < 8; ++o) {
      const std::int32_t child = octree.node_children[8 * node + static_cast<std::size_t>(o)];
      if (child < 0) {
        leaf_parent_[~child] = static_cast<std::int32_t>(node);
        continue;
      }
      const std::int32_t* const around = &node_neighbours_[27 * node];
      for (std::size_t d = 0; d < 27; ++d) {
        const auto& [direction, of_it, step] = kNeighbourSteps.beside[o][d];
        const std::int32_t other = around[direction];
        if (other < 0 && other != kOutside)
          throw Error(ExitCode::kInput,
                      "the octree is not balanced 2:1: the raster or sizing is damaged; make it again");
        // Balanced: beside a node there is always a cell of its size, or the end of the root cube.
        node_neighbours_[27 * static_cast<std::size_t>(child) + d] = other == kOutside ? other : children(other)[of_it];
      }
    }
  }
}

}  // namespace st
