// Cells that touch: across faces, edges and corners of a balanced octree, by table instead of by search.
#pragma once

#include <array>
#include <limits>

#include "sizing/octree.h"

namespace st {

/// Displacement from a cell's centre to a neighbour's, in halves of the smaller cell's edge: 2 per axis between equals;
/// +-1 or +-3 between a cell and one of half its size.
struct CellStep {
  std::int8_t x, y, z;
  std::int8_t length2;      ///< x*x + y*y + z*z: one of 4 8 12 (equals), 11 19 27
  std::uint8_t fine_level;  ///< level of the smaller cell

  /// Otherwise they touch at an edge or a corner.
  bool is_across_face() const { return (x < -1 || x > 1) + (y < -1 || y > 1) + (z < -1 || z > 1) == 1; }
};

/// Neighbour tables of a balanced octree: for each node its 27 neighbours of the same size, for each leaf its parent.
/// 20 bytes per leaf.
class Neighbours {
 public:
  /// Precondition: octree_tree_defect() is "". Throws Error(kInput) unless it is balanced 2:1 across faces, edges and
  /// corners.
  explicit Neighbours(const OctreeView& octree);

  const OctreeView& octree() const { return octree_; }

  /// Calls f(leaf, step) for every leaf that touches `leaf`, in a fixed order. A larger neighbour may come several
  /// times (once for each of the directions in which it lies), always with the same step.
  template <class F>
  void for_each(std::int32_t leaf, F&& f) const;

  /// Likewise, those across faces alone.
  template <class F>
  void for_each_across_face(std::int32_t leaf, F&& f) const {
    if (octree_.node_children.empty()) return;
    for (int d = -1; d <= 1; d += 2) {
      visit_direction(leaf, d, 0, 0, f);
      visit_direction(leaf, 0, d, 0, f);
      visit_direction(leaf, 0, 0, d, f);
    }
  }

 private:
  static constexpr std::int32_t kOutside = std::numeric_limits<std::int32_t>::min();
  static int direction(int x, int y, int z) { return (x + 1) + 3 * (y + 1) + 9 * (z + 1); }
  /// The cell beside child `octant` of `node` in direction (x, y, z): of the same size as the child, or one level
  /// larger; or kOutside.
  std::int32_t beside(std::int32_t node, int octant, int x, int y, int z, bool& is_larger) const {
    const int cx = (octant & 1) + x, cy = (octant >> 1 & 1) + y, cz = (octant >> 2) + z;
    const std::int32_t parent = node_neighbours_[27 * static_cast<std::size_t>(node) +
                                                 static_cast<std::size_t>(direction(cx >> 1, cy >> 1, cz >> 1))];
    is_larger = parent < 0;
    if (parent < 0) return parent;
    return octree_.node_children[8 * static_cast<std::size_t>(parent) +
                                 static_cast<std::size_t>((cx & 1) | (cy & 1) << 1 | (cz & 1) << 2)];
  }
  template <class F>
  void visit_direction(std::int32_t leaf, int x, int y, int z, F&& f) const;

  OctreeView octree_;
  std::vector<std::int32_t> node_neighbours_;  // [27*n_nodes] node, ~leaf or kOutside
  std::vector<std::int32_t> leaf_parent_;      // [n_leaves]
};

template <class F>
void Neighbours::for_each(std::int32_t leaf, F&& f) const {
  if (octree_.node_children.empty()) return;
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        if (x != 0 || y != 0 || z != 0) visit_direction(leaf, x, y, z, f);
}

template <class F>
void Neighbours::visit_direction(std::int32_t leaf, int x, int y, int z, F&& f) const {
  const std::size_t l = static_cast<std::size_t>(leaf);
  const std::uint8_t level = octree_.leaf_levels[l];
  const int octant = static_cast<int>(octree_.leaf_keys[l] >> (3 * (kMaxLevel - level))) & 7;
  bool is_larger = false;
  const std::int32_t other = beside(leaf_parent_[l], octant, x, y, z, is_larger);
  if (other == kOutside) return;
  const auto step = [](int sx, int sy, int sz, int fine_level) {
    return CellStep{static_cast<std::int8_t>(sx), static_cast<std::int8_t>(sy), static_cast<std::int8_t>(sz),
                    static_cast<std::int8_t>(sx * sx + sy * sy + sz * sz), static_cast<std::uint8_t>(fine_level)};
  };
  if (is_larger) {  // per axis: 3 across the parent's side, else towards the middle of the parent
    const auto offset = [](int bit, int d) { return bit + d < 0 ? -3 : bit + d > 1 ? 3 : bit ? -1 : 1; };
    f(~other, step(offset(octant & 1, x), offset(octant >> 1 & 1, y), offset(octant >> 2, z), level));
  } else if (other < 0) {
    f(~other, step(2 * x, 2 * y, 2 * z, level));
  } else {  // its children on our side
    for (int o = 0; o < 8; ++o) {
      const int bx = o & 1, by = o >> 1 & 1, bz = o >> 2;
      if ((x != 0 && bx != (x < 0)) || (y != 0 && by != (y < 0)) || (z != 0 && bz != (z < 0))) continue;
      const auto offset = [](int bit, int d) { return d != 0 ? 3 * d : 2 * bit - 1; };
      f(~octree_.node_children[8 * static_cast<std::size_t>(other) + static_cast<std::size_t>(o)],
        step(offset(bx, x), offset(by, y), offset(bz, z), level + 1));
    }
  }
}

}  // namespace st
