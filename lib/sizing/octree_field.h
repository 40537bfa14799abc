// The size field of an octree: a lookup and a linear function.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/similarity.h"
#include "sizing/blanking.h"
#include "sizing/cone_kernels.h"
#include "sizing/cones.h"
#include "sizing/octree.h"
#include "sizing/size_field.h"
#include "sizing/source_tree.h"

namespace st {

/// Lengths at the centres of all cells. Arrays are [n_leaves].
struct ProlongedLengths {
  std::vector<CellLength> cells;
  std::vector<std::int32_t> cause;              ///< whose sample length it goes back to; kNone: the largest length
  std::vector<CellLength> second_cells = {};    ///< [n_split] of the second parts of cells that a surface splits; their
                                                ///< `upper` is negated in `cells`
  std::vector<std::int32_t> second_cause = {};  ///< [n_split]
};

/// Arrays and numbers of a prolonged octree.
struct OctreeFieldData {
  OctreeView octree;
  std::span<const CellLength> cells;    ///< [n_leaves]
  std::span<const std::int32_t> cause;  ///< [n_leaves] of `cells`; see pack_cause
  double slope = 0;                     ///< largest change of length per distance
  double scale = 1;                     ///< multiplies every answer
  /// Leaves that a surface splits (Blanking), [n_split] each; `cells` and `cause` hold their first part.
  std::span<const std::int32_t> split_leaf = {};
  std::span<const CellSplit> split = {};
  std::span<const CellLength> second_cells = {};
  std::span<const std::int32_t> second_cause = {};
  double max_aspect = 1;  ///< largest length along a direction over the length
  ConeView cones = {};    ///< they tell the lengths; without any, each leaf has one length, that of `cells`
  double max_length = 0;  ///< with cones: where nothing asks for less
  const SourceTree* sources = nullptr;  ///< in the octree's frame, before scale; asked everywhere. Null: none

  void set_cones(const ConeTable& table, double largest) { cones = table.view(), max_length = largest; }
};

/// What stands behind the length at a place.
struct SizeExplanation {
  std::int32_t leaf = 0;
  int level = 0;
  double cell_edge = 0;  ///< model unit
  double length = 0;     ///< likewise
  double along = 0;      ///< as local_on() answers, likewise the direction
  Vec3 direction;
  Vec3 gradient;
  std::int32_t cause = kNone;  ///< see pack_cause
  Vec3 origin;                 ///< the place of the sample or source that it goes back to; of the largest length: here
  double origin_length = 0;    ///< what is asked for there
};

/// By the cones of `data`: lengths, gradients and causes at the centres of all sites, before scale and without sources,
/// and no length in a leaf above its `upper`. What `cells` are; those of `data` are not looked at. `teller`
/// [n_sites]: the cones that tell the lengths there, see ConeTable.
ProlongedLengths lengths_at_centers(const OctreeFieldData& data, std::span<const std::int32_t> teller);

/// h(x) is the smallest of what the octree tells and of what the sources ask for at x, times scale. The octree tells
/// the smallest of length + slope * distance over the cones of the site at x, and of the largest length; beyond the
/// root cube by the cones of the nearest leaf. Where a surface splits the leaf, the site is the part that x lies in;
/// the smaller length counts when that is not certain.
class OctreeField : public SizeField {
 public:
  /// `owner` keeps the arrays alive (vectors, a mapped artifact). O(n): looks for the smallest length, unless
  /// `min_length` (before scale) is known.
  OctreeField(const OctreeFieldData& data, std::shared_ptr<const void> owner, double min_length = 0);

  using SizeField::size;
  double size(Vec3 xyz, int& hint) const override;
  LocalSize local(Vec3 xyz, int& hint) const override { return local_on(xyz, {}, hint); }
  LocalSize local_on(Vec3 xyz, Vec3 normal, int& hint) const override;
  bool has_metrics() const override { return data_.sources && data_.sources->has_metrics(); }
  bool is_stretched() const override {
    return octree_is_stretched() || (data_.sources && data_.sources->max_aspect() > 1);
  }
  double min_size() const override { return min_size_; }
  double slope() const override { return data_.slope * data_.scale; }
  const OctreeFieldData& data() const { return data_; }
  /// Where the octree lies: its point x (leaves, split planes) at frame()(x) of the model, in which all questions are
  /// asked.
  virtual Similarity frame() const { return {}; }
  /// `normal`: as for local_on().
  virtual SizeExplanation explain(Vec3 xyz, Vec3 normal = {}) const;
  /// The sources that may tell a length somewhere in a leaf.
  FewSources sources_in(std::int32_t leaf) const { return data_.sources ? sources_near(leaf) : FewSources(nullptr, 0); }
  /// Likewise size() in the octree's own frame, its gradient and its cause.
  double size_and_gradient(Vec3 xyz, int& hint, Vec3& gradient, std::int32_t& cause) const;

 private:
  struct Place {
    Vec3 xyz;      // in the octree's frame
    Vec3 from_lo;  // from the lower corner of the root
    Vec3 on_grid;  // in units of the deepest cells, moved into the root
  };
  /// What tells the length at a place.
  struct Answer {
    double length = 0;  // scaled
    Vec3 gradient;      // likewise
    std::int32_t cause = kNone;
    std::int32_t cone = kNone, source = kNone;  // if it is one
  };

  bool octree_is_stretched() const { return !data_.cones.stretch.empty(); }
  Place locate(Vec3 xyz, int& hint) const;
  Vec3 from_center(std::int32_t leaf, const Place& x) const;
  /// Of a site.
  std::int32_t leaf_of(std::int32_t site) const {
    const std::int32_t n = data_.octree.n_leaves();
    return site < n ? site : data_.split_leaf[site - n];
  }
  struct Sites {
    std::int32_t first, second;  // second: kNone, or the smaller length of both counts
  };
  Sites find_sites(std::int32_t leaf, const Place& x) const;
  /// The leaf, or the second part of one that is split.
  std::int32_t find_site(std::int32_t leaf, const Place& x) const;
  LocalSize local_in(std::int32_t site, const Place& x) const;
  LocalSize cone_local(std::int32_t site, const Place& x) const;
  const CellLength& cell_of(std::int32_t site) const {
    const std::int32_t n = data_.octree.n_leaves();
    return site < n ? data_.cells[site] : data_.second_cells[site - n];
  }
  /// Before scale. `winner` (may be null): the cone that tells it, or kNone.
  double length_at(std::int32_t site, const Place& x, std::int32_t* winner = nullptr) const;
  double scaled(double length) const { return std::max(data_.scale * length, min_size_); }
  Answer answer_at(std::int32_t site, const Place& x) const;
  /// Before scale: the smallest of `length` at x in a leaf and of what sources ask for there; see SourceTree.
  double source_length(std::int32_t leaf, const Place& x, double length) const {
    if (!data_.sources) return length;
    if (!is_inside(x)) return data_.sources->size_below(x.xyz, length);
    const FewSources near = sources_near(leaf);
    return near.are_none() ? length : data_.sources->size_below(x.xyz, length, near);
  }
  /// Of the root cube.
  bool is_inside(const Place& x) const {
    return std::min({x.from_lo.x, x.from_lo.y, x.from_lo.z}) >= 0 &&
           std::max({x.from_lo.x, x.from_lo.y, x.from_lo.z}) <= data_.octree.edge;
  }
  /// Those that may tell a length somewhere in the leaf. Precondition: there are sources.
  FewSources sources_near(std::int32_t leaf) const {
    const auto known = FewSources::from_bits(near_[leaf].load(std::memory_order_relaxed));
    return known.is_known() ? known : find_near(leaf);
  }
  FewSources find_near(std::int32_t leaf) const;
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
  const ConeKernels& kernels_ = cone_kernels();
  std::vector<std::int32_t> top_;  // [8^kTopLevel] node of that level, or ~leaf: the first steps of every search in one
  std::vector<std::uint64_t> is_split_;  // a bit for each leaf, smaller than looking into `cells`; empty: none is
  std::unique_ptr<std::atomic<std::uint64_t>[]> near_;  // [n_leaves] FewSources, where there are sources
  std::shared_ptr<const void> owner_;
  double unit_;     // edge of a grid cell
  double to_grid_;  // 1 / unit_
  double min_size_ = 0;
};

}  // namespace st
