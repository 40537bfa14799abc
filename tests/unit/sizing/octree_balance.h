// Whether an octree is what it must be, its balance included: leaf by leaf, unlike Neighbours.
#pragma once

#include "base/morton.h"
#include "sizing/octree.h"

namespace st::test {

inline const char* balance_defect(const OctreeView& octree) {
  for (std::int32_t leaf = 0; leaf < octree.n_leaves(); ++leaf) {
    const int level = octree.leaf_levels[leaf];
    const GridPoint p = morton::decode(octree.leaf_keys[leaf]);
    const std::uint32_t extent = morton::cell_extent(level);
    for (int d = 0; d < 27; ++d) {
      const GridPoint q{p.x + (d % 3 - 1u) * extent, p.y + (d / 3 % 3 - 1u) * extent, p.z + (d / 9 - 1u) * extent};
      if (q.x >= kCoordinateEnd || q.y >= kCoordinateEnd || q.z >= kCoordinateEnd) continue;
      if (octree.leaf_levels[octree.find_leaf(morton::encode(q))] + 1 < level) return "not balanced 2:1";
    }
  }
  return "";
}

/// First defect of an octree's arrays, or of its balance; or "".
inline const char* octree_defect(const OctreeView& octree) {
  const char* const defect = octree_tree_defect(octree);
  return *defect != '\0' ? defect : balance_defect(octree);
}

}  // namespace st::test
