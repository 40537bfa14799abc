// The size field of an octree: a lookup and a linear function.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "base/similarity.h"
#include "sizing/blanking.h"
#include "sizing/octree.h"
#include "sizing/size_field.h"

namespace st {

/// Arrays and numbers of a prolonged octree.
struct OctreeFieldData {
  OctreeView octree;
  std::span<const CellLength> cells;    ///< [n_leaves]
  std::span<const std::int32_t> cause;  ///< [n_leaves]; see pack_cause
  double slope = 0;                     ///< largest change of length per distance
  double scale = 1;                     ///< multiplies every answer
  /// Leaves that a surface splits (Blanking), [n_split] each; `cells` and `cause` hold their first part.
  std::span<const std::int32_t> split_leaf = {};
  std::span<const CellSplit> split = {};
  std::span<const CellLength> second_cells = {};
  std::span<const std::int32_t> second_cause = {};
  std::span<const CellLength> along = {};       ///< [n_sites] see StretchedCells; empty: no stretch
  std::span<const SmallNormal> direction = {};  ///< [n_sites]
  double max_aspect = 1;
};

/// What stands behind the length at a place.
struct SizeExplanation {
  std::int32_t leaf = 0;
  int level = 0;
  double cell_edge = 0;  ///< model unit
  double length = 0;     ///< as size() answers
  double along = 0;      ///< as local() answers, likewise the direction
  Vec3 direction;
  Vec3 gradient;
  std::int32_t cause = kNone;  ///< see pack_cause
};

/// h(x) = min(length + gradient . (x - centre), upper) of the leaf at x, times scale. Never leaves the range of the
/// lengths of the leaf and its neighbours. Where a surface splits the leaf, those of the part that x lies in; the
/// smaller one when that is not certain.
class OctreeField : public SizeField {
 public:
  /// `owner` keeps the arrays alive (vectors, a mapped artifact). Precondition: arrays as prolong() makes them. O(n):
  /// looks for the smallest length, unless `min_length` (before scale) is known.
  OctreeField(const OctreeFieldData& data, std::shared_ptr<const void> owner, double min_length = 0);

  using SizeField::size;
  double size(Vec3 xyz, int& hint) const override;
  LocalSize local(Vec3 xyz, int& hint) const override;
  bool is_stretched() const override { return !data_.along.empty(); }
  double min_size() const override { return min_size_; }
  double slope() const override { return data_.slope * data_.scale; }
  const OctreeFieldData& data() const { return data_; }
  /// Where the octree lies: its point x (leaves, split planes) at frame()(x) of the model, in which all questions are
  /// asked.
  virtual Similarity frame() const { return {}; }
  virtual SizeExplanation explain(Vec3 xyz) const;
  /// Likewise size() in the octree's own frame, its gradient and its cause.
  double size_and_gradient(Vec3 xyz, int& hint, Vec3& gradient, std::int32_t& cause) const;

 private:
  Vec3 locate(Vec3 xyz, int& hint) const;
  /// At d from the centre of the leaf, in its part (kNone: the first).
  LocalSize local_in(std::int32_t leaf, std::int32_t second, Vec3 d) const;
  double length_in(const CellLength& cell, Vec3 d) const {
    const double rise = cell.gradient[0] * d.x + cell.gradient[1] * d.y + cell.gradient[2] * d.z;
    return std::max(data_.scale * std::min<double>(cell.length + rise, std::abs(cell.upper)), min_size_);
  }
  /// Part of a split leaf at d from its centre: kNone the first, or the index of the second.
  std::int32_t find_part(std::int32_t leaf, Vec3 d) const;
  void fill_top(std::int32_t node, int level, std::size_t first);
  /// As OctreeView::find_leaf, by way of the table.
  std::int32_t find_leaf(std::uint64_t key, int& level) const {
    std::int32_t node = top_[key >> (3 * (kMaxLevel - kTopLevel))];
    if (node < 0) {
      level = data_.octree.leaf_levels[~node];
      return ~node;
    }
    for (level = kTopLevel; node >= 0; ++level)
      node =
          data_.octree.node_children[8 * static_cast<std::size_t>(node) + ((key >> (3 * (kMaxLevel - 1 - level))) & 7)];
    return ~node;
  }

  static constexpr int kTopLevel = 5;
  OctreeFieldData data_;
  std::vector<std::int32_t> top_;  // [8^kTopLevel] node of that level, or ~leaf: the first steps of every search in one
  std::shared_ptr<const void> owner_;
  double unit_;     // edge of a grid cell
  double to_grid_;  // 1 / unit_
  double min_size_ = 0;
};

}  // namespace st
