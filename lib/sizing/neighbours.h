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
  std::int8_t length2;      ///< x*x + y*y + z*z: one of 4 8 12 (equals), 11 19 27; across faces 4 and 11
  std::uint8_t fine_level;  ///< level of the smaller cell
};

/// Where the neighbours of a cell are found, by its octant and direction ((x + 1) + 3 * (y + 1) + 9 * (z + 1)), and how
/// far they lie; `fine_level` of these steps is 0.
struct NeighbourSteps {
  struct Beside {
    std::uint8_t direction, child;  // of the parent; of the node there
    CellStep larger;                // if there is no node, but a leaf
  };
  struct Finer {  // children on our side
    std::uint8_t n = 0;
    std::array<std::uint8_t, 4> child{};
    std::array<CellStep, 4> step{};
  };
  std::array<std::array<Beside, 27>, 8> beside{};
  std::array<CellStep, 27> equal{};
  std::array<Finer, 27> finer{};

  static constexpr CellStep step(int x, int y, int z) {
    return {static_cast<std::int8_t>(x), static_cast<std::int8_t>(y), static_cast<std::int8_t>(z),
            static_cast<std::int8_t>(x * x + y * y + z * z), 0};
  }
  constexpr NeighbourSteps() {
    for (int d = 0; d < 27; ++d) {
      const int x = d % 3 - 1, y = d / 3 % 3 - 1, z = d / 9 - 1;
      equal[d] = step(2 * x, 2 * y, 2 * z);
      for (int o = 0; o < 8; ++o) {
        const int bx = o & 1, by = o >> 1 & 1, bz = o >> 2, cx = bx + x, cy = by + y, cz = bz + z;
        // per axis: 3 across the parent's side, else towards the middle of the parent
        const auto to_larger = [](int bit, int along) {
          return bit + along < 0 ? -3 : bit + along > 1 ? 3 : bit ? -1 : 1;
        };
        beside[o][d] = {static_cast<std::uint8_t>(((cx >> 1) + 1) + 3 * ((cy >> 1) + 1) + 9 * ((cz >> 1) + 1)),
                        static_cast<std::uint8_t>((cx & 1) | (cy & 1) << 1 | (cz & 1) << 2),
                        step(to_larger(bx, x), to_larger(by, y), to_larger(bz, z))};
        if ((x != 0 && bx != (x < 0)) || (y != 0 && by != (y < 0)) || (z != 0 && bz != (z < 0)) || d == 13) continue;
        const auto to_finer = [](int bit, int along) { return along != 0 ? 3 * along : 2 * bit - 1; };
        Finer& children = finer[d];
        children.child[children.n] = static_cast<std::uint8_t>(o);
        children.step[children.n++] = step(to_finer(bx, x), to_finer(by, y), to_finer(bz, z));
      }
    }
  }
};
inline constexpr NeighbourSteps kNeighbourSteps;

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
    const Place place(*this, leaf);
    for (const int d : kAcross) visit_direction(place, d, f);
  }

  /// Likewise, each once: calls f(leaf, step, n), where it is the n-th that for_each() comes to, in its order.
  template <class F>
  void for_each_across_face_numbered(std::int32_t leaf, F&& f) const {
    if (octree_.node_children.empty()) return;
    const Place place(*this, leaf);
    int n = 0;
    for (int d = 0; d < 27; ++d) {
      if (kIsAcross >> d & 1)
        visit_direction(place, d, [&](std::int32_t other, const CellStep& step) { f(other, step, n++); });
      else if (d != kOwn)
        n += count_in_direction(place, d);
    }
  }

  /// Likewise, calls f(leaf, side): 2 * axis of the lower side, and one more of the upper.
  template <class F>
  void for_each_across_side(std::int32_t leaf, F&& f) const {
    if (octree_.node_children.empty()) return;
    const Place place(*this, leaf);
    constexpr int kSide[6] = {0, 2, 4, 1, 3, 5};
    for (int k = 0; k < 6; ++k)
      visit_direction(place, kAcross[k], [&](std::int32_t other, const CellStep&) { f(other, kSide[k]); });
  }

 private:
  static constexpr std::int32_t kOutside = std::numeric_limits<std::int32_t>::min();
  static constexpr int kOwn = 13;  // the direction of the cell itself
  static constexpr int kAcross[6] = {12, 10, 4, 14, 16, 22};
  static constexpr std::uint32_t kIsAcross = 1u << 12 | 1u << 10 | 1u << 4 | 1u << 14 | 1u << 16 | 1u << 22;
  /// Of a leaf among the cells of its parent.
  struct Place {
    const std::int32_t* around;  // its parent
    const std::array<NeighbourSteps::Beside, 27>& beside;
    std::uint8_t level;

    Place(const Neighbours& n, std::int32_t leaf)
        : around(&n.node_neighbours_[27 * static_cast<std::size_t>(n.leaf_parent_[leaf])]),
          beside(
              kNeighbourSteps.beside[n.octree_.leaf_keys[leaf] >> (3 * (kMaxLevel - n.octree_.leaf_levels[leaf])) & 7]),
          level(n.octree_.leaf_levels[leaf]) {}
  };
  const std::int32_t* children(std::int32_t node) const {
    return &octree_.node_children[8 * static_cast<std::size_t>(node)];
  }
  template <class F>
  void visit_direction(const Place& place, int direction, F&& f) const;
  /// How often visit_direction() calls.
  int count_in_direction(const Place& place, int direction) const {
    const NeighbourSteps::Beside& beside = place.beside[direction];
    const std::int32_t node = place.around[beside.direction];
    if (node < 0) return node != kOutside;
    return children(node)[beside.child] < 0 ? 1 : kNeighbourSteps.finer[direction].n;
  }

  OctreeView octree_;
  std::vector<std::int32_t> node_neighbours_;  // [27*n_nodes] node, ~leaf or kOutside
  std::vector<std::int32_t> leaf_parent_;      // [n_leaves]
};

template <class F>
void Neighbours::for_each(std::int32_t leaf, F&& f) const {
  if (octree_.node_children.empty()) return;
  const Place place(*this, leaf);
  for (int d = 0; d < 27; ++d)
    if (d != kOwn) visit_direction(place, d, f);
}

template <class F>
void Neighbours::visit_direction(const Place& place, int direction, F&& f) const {
  const auto at_level = [](CellStep step, int level) {
    step.fine_level = static_cast<std::uint8_t>(level);
    return step;
  };
  const NeighbourSteps::Beside& beside = place.beside[direction];
  const std::int32_t node = place.around[beside.direction];
  if (node == kOutside) return;
  if (node < 0) return f(~node, at_level(beside.larger, place.level));
  const std::int32_t other = children(node)[beside.child];
  if (other < 0) return f(~other, at_level(kNeighbourSteps.equal[direction], place.level));
  const NeighbourSteps::Finer& finer = kNeighbourSteps.finer[direction];
  for (int k = 0; k < finer.n; ++k) f(~children(other)[finer.child[k]], at_level(finer.step[k], place.level + 1));
}

}  // namespace st
