#include "sizing/octree_tets.h"

#include <algorithm>

#include "base/limits.h"
#include "base/radix_sort.h"

namespace st {
namespace {

class TetMaker {
 public:
  explicit TetMaker(const OctreeView& octree) : octree_(octree) {}

  OctreeTets make() {
    collect_corners();
    for (std::int32_t leaf = 0; leaf < octree_.n_leaves(); ++leaf) fill_leaf(leaf);
    return std::move(result_);
  }

 private:
  void collect_corners() {
    for (std::int32_t leaf = 0; leaf < octree_.n_leaves(); ++leaf)
      for (const std::uint64_t c : packed_corners(octree_.leaf_keys[leaf], octree_.leaf_levels[leaf]))
        corners_.push_back(c);
    sort_unique(corners_);
    const double unit = octree_.edge / kCoordinateEnd;
    for (const std::uint64_t key : corners_) {
      const GridPoint p = unpack_corner(key);
      result_.node_xyz.push_back({octree_.lo.x + p.x * unit, octree_.lo.y + p.y * unit, octree_.lo.z + p.z * unit});
    }
    result_.n_corners = static_cast<std::int64_t>(corners_.size());
    require_countable(corners_.size() + octree_.leaf_keys.size(), "corners and centres of the octree's cells");
    for (std::int32_t leaf = 0; leaf < octree_.n_leaves(); ++leaf)
      result_.node_xyz.push_back(octree_.leaf_center(leaf));
  }

  std::int32_t corner(std::uint64_t key) const {
    const auto it = std::lower_bound(corners_.begin(), corners_.end(), key);
    return it != corners_.end() && *it == key ? static_cast<std::int32_t>(it - corners_.begin()) : kNone;
  }

  void fill_leaf(std::int32_t leaf) {
    const std::uint64_t lo = pack_corner(morton::decode(octree_.leaf_keys[leaf]));
    const std::uint64_t e = morton::cell_extent(octree_.leaf_levels[leaf]);
    apex_ = static_cast<std::int32_t>(result_.n_corners) + leaf;
    constexpr std::uint64_t step[3] = {1, 1ull << kCornerBits, 1ull << (2 * kCornerBits)};
    for (int axis = 0; axis < 3; ++axis)
      for (std::uint64_t side = 0; side < 2; ++side)
        fill_square(lo + side * e * step[axis], e, step[(axis + 1) % 3], step[(axis + 2) % 3]);
  }

  /// The square at `lo` with sides e*u and e*v: in four when a finer leaf has a corner in its middle, else a fan around
  /// one of its corners.
  void fill_square(std::uint64_t lo, std::uint64_t e, std::uint64_t u, std::uint64_t v) {
    const std::uint64_t h = e / 2;
    if (h > 0 && corner(lo + h * (u + v)) != kNone) {
      for (const std::uint64_t s : {std::uint64_t{0}, h * u, h * v, h * (u + v)}) fill_square(lo + s, h, u, v);
      return;
    }
    const std::uint64_t around[4] = {lo, lo + e * u, lo + e * (u + v), lo + e * v};
    std::int32_t polygon[8];
    int n = 0, first = -1;
    bool first_is_middle = false;
    const auto add = [&](std::int32_t node, bool is_middle) {
      const bool is_better =
          first < 0 || is_middle > first_is_middle || (is_middle == first_is_middle && node < polygon[first]);
      polygon[n] = node;
      if (is_better) {
        first = n;
        first_is_middle = is_middle;
      }
      ++n;
    };
    for (int k = 0; k < 4; ++k) {
      add(corner(around[k]), false);
      const std::uint64_t middle = around[k] / 2 + around[(k + 1) % 4] / 2 + (around[k] & around[(k + 1) % 4] & 1);
      const std::int32_t node = h > 0 ? corner(middle) : kNone;
      if (node != kNone) add(node, true);
    }
    for (int k = 1; k + 1 < n; ++k) add_tet(polygon[first], polygon[(first + k) % n], polygon[(first + k + 1) % n]);
  }

  void add_tet(std::int32_t a, std::int32_t b, std::int32_t c) {
    const auto& x = result_.node_xyz;
    const Vec3 o = x[apex_];
    if (dot(cross(x[a] - o, x[b] - o), x[c] - o) < 0) std::swap(b, c);
    result_.tets.push_back({apex_, a, b, c});
  }

  const OctreeView octree_;
  std::vector<std::uint64_t> corners_;
  OctreeTets result_;
  std::int32_t apex_ = 0;
};

}  // namespace

OctreeTets octree_tets(const OctreeView& octree) { return TetMaker(octree).make(); }

}  // namespace st
