// Linear octree of sample lengths: Morton-ordered leaves, built from raster boxes, 2:1 balanced.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "base/morton.h"
#include "base/vec.h"
#include "sizing/sample_reach.h"

namespace st {

/// Why a cell has its length. Packed into an int32: id * 4 + kind; kNone (-1): nothing asks for less than the largest
/// length.
enum class CauseKind : std::uint8_t { kEdge = 0, kFace = 1, kSource = 2, kOther = 3 };
constexpr std::int32_t pack_cause(CauseKind kind, std::int32_t id) { return id * 4 + static_cast<std::int32_t>(kind); }
constexpr CauseKind cause_kind(std::int32_t cause) { return static_cast<CauseKind>(cause & 3); }
constexpr std::int32_t cause_id(std::int32_t cause) { return cause >> 2; }

/// A direction in three bytes; 128, 128, 128: unknown.
struct SmallNormal {
  std::uint8_t x = 128, y = 128, z = 128;  ///< of the unit vector, times 127, plus 128

  SmallNormal() = default;
  explicit SmallNormal(Vec3 unit) : x(round(unit.x)), y(round(unit.y)), z(round(unit.z)) {}
  explicit operator Vec3() const { return Vec3{x - 128.0, y - 128.0, z - 128.0} / 127; }
  SmallNormal reversed() const { return SmallNormal(-Vec3(*this)); }

 private:
  static std::uint8_t round(double v) { return static_cast<std::uint8_t>(127 * v + 128.5); }
};

/// Longer lengths along a direction; `along` 0: the same length in all directions.
struct SampleStretch {
  SmallNormal direction = {};
  float along = 0;  ///< model unit
};

/// A sample of the geometry: the cube center +- half asks for `length`. Its edge is cell_per_length times the length.
struct RasterBox {
  Vec3 center;       ///< model unit
  float half = 0;    ///< half the edge, model unit, > 0
  float length = 0;  ///< sample length, model unit, > 0
  std::int32_t cause = kNone;
  SmallNormal normal = {};  ///< of the surface there, out of the solid; unknown on edges
  SampleStretch stretch = {};
  SampleReach reach = {};
};

/// The shape of an octree over arrays that somebody else owns (vectors, or a mapped artifact).
/// Leaf arrays are in Morton order; node 0 is the root; nodes are the inner cells, level by level.
struct OctreeView {
  Vec3 lo;                                      ///< lower corner of the root cube, model unit
  double edge = 1;                              ///< its edge, model unit, > 0
  std::span<const std::uint64_t> leaf_keys;     ///< [n_leaves] Morton key of the lower corner, strictly ascending
  std::span<const std::uint8_t> leaf_levels;    ///< [n_leaves] 0 .. kMaxLevel; edge of the leaf = edge / 2^level
  std::span<const std::int32_t> node_children;  ///< [8*n_nodes] >= 0: node; < 0: leaf ~child. Empty when the root is
                                                ///< the only leaf

  std::int32_t n_leaves() const { return static_cast<std::int32_t>(leaf_keys.size()); }
  std::int32_t n_nodes() const { return static_cast<std::int32_t>(node_children.size() / 8); }
  double cell_edge(int level) const { return edge / static_cast<double>(1u << level); }
  Vec3 leaf_center(std::int32_t leaf) const;
  /// Grid position of `xyz`; points outside the root are clamped to it.
  GridPoint grid_point(Vec3 xyz) const;
  /// Leaf that contains the grid point with this key. About the depth of the tree.
  std::int32_t find_leaf(std::uint64_t key) const {
    int level = 0;
    return find_leaf(key, level);
  }
  /// Likewise, and its level.
  std::int32_t find_leaf(std::uint64_t key, int& level) const {
    std::int32_t node = node_children.empty() ? ~0 : 0;
    for (level = 0; node >= 0; ++level)
      node = node_children[8 * static_cast<std::size_t>(node) + ((key >> (3 * (kMaxLevel - 1 - level))) & 7)];
    return ~node;
  }
  bool leaf_contains(std::int32_t leaf, std::uint64_t key) const {
    return ((key ^ leaf_keys[leaf]) >> (3 * (kMaxLevel - leaf_levels[leaf]))) == 0;
  }
};

/// Owned shape of an octree.
struct OctreeShape {
  Vec3 lo;
  double edge = 1;
  std::vector<std::uint64_t> leaf_keys;
  std::vector<std::uint8_t> leaf_levels;
  std::vector<std::int32_t> node_children;

  OctreeView view() const { return {lo, edge, leaf_keys, leaf_levels, node_children}; }
};

/// Octree before prolongation: the raster.
struct RasterOctree {
  OctreeShape shape;
  std::vector<float> stored_length;  ///< [n_leaves] smallest sample length that met the cell, model unit; +infinity:
                                     ///< none did
  std::vector<std::int32_t> stored_cause;  ///< [n_leaves] its cause (the smallest of equal lengths'), kNone: none
};

/// Length of one leaf.
struct CellLength {
  float length = 0;               ///< at the centre, model unit, > 0
  float gradient[3] = {0, 0, 0};  ///< change of length per distance there
  float upper = 0;                ///< bound of all lengths in the leaf, model unit; negated where a surface splits it

  /// At the centre, the bound taken.
  float at_centre() const { return std::min(length, std::abs(upper)); }
};

/// Cube around `box`, enlarged by 1 % on each side; edge 1 for an empty box or a single point.
void octree_root(const Box3& box, Vec3& lo, double& edge);

/// Coarsest 2:1-balanced octree (across faces, edges and corners) in the root cube whose leaves are not larger than any
/// raster box they meet; depth capped at kMaxLevel. Each leaf stores the smallest length of the boxes that meet it. The
/// result depends on the set of boxes only, not on their order. Parts of boxes outside the root are ignored. O(n log n)
/// in boxes and cells.
RasterOctree build_octree(const Box3& root, std::span<const RasterBox> boxes);

/// First defect of an octree's arrays (lengths, order, gaps, links), or "". O(n): for every artifact that is read.
const char* octree_tree_defect(const OctreeView& octree);

}  // namespace st
