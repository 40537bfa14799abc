#include "sizing/refine.h"

#include <cmath>
#include <string>

#include "base/assert.h"
#include "base/error.h"
#include "sizing/octree_nodes.h"

namespace st {
namespace {

constexpr double kLeastShare = 0.8;  // of the least length in a cell that is not split in the largest

/// A cell on the way down from the root.
struct Cell {
  std::uint64_t key = 0;  // relative to its level
  int level = 0;
  Vec3 center;
  double edge = 0;

  Cell child(std::uint64_t o) const {
    const double q = 0.25 * edge;
    const Vec3 step{o & 1 ? q : -q, o & 2 ? q : -q, o & 4 ? q : -q};
    return {key << 3 | o, level + 1, center + step, 0.5 * edge};
  }
};

class Refinement {
 public:
  Refinement(const OctreeField& field, const RefineOptions& options)
      : field_(field), octree_(field.data().octree), sources_(*field.data().sources), options_(options) {}

  /// All inner cells: the octree's, and where sources ask for more.
  NodeLevels split() {
    const double half = 0.5 * octree_.edge;
    collect(octree_.node_children.empty() ? ~0 : 0, {0, 0, octree_.lo + Vec3{half, half, half}, octree_.edge});
    return std::move(nodes_);
  }

 private:
  void collect(std::int32_t node, const Cell& cell) {
    if (node < 0) return split_leaf(cell);
    nodes_[cell.level].push_back(cell.key);
    for (std::uint64_t o = 0; o < 8; ++o)
      collect(octree_.node_children[8 * static_cast<std::size_t>(node) + o], cell.child(o));
  }

  void split_leaf(const Cell& cell) {
    if (!is_coarse(cell)) return;
    nodes_[cell.level].push_back(cell.key);
    if (7 * ++n_added_ + octree_.n_leaves() > options_.max_leaves)
      throw Error(ExitCode::kUsage, "sources: need more than " + std::to_string(options_.max_leaves) +
                                        " cells; make their lengths larger or the sources smaller");
    for (std::uint64_t o = 0; o < 8; ++o) split_leaf(cell.child(o));
  }

  bool is_coarse(const Cell& cell) {
    if (cell.level >= kMaxLevel) return false;
    const double length = length_at(cell.center),
                 least = sources_.least_near(cell.center, 0.5 * std::sqrt(3.0) * cell.edge, length);
    if (cell.edge <= options_.cell_per_length * least) return false;
    return least < kLeastShare * length || (sources_.tells(cell.center, length) && rises(cell, length));
  }
  /// Whether a corner has a much larger length than the centre.
  bool rises(const Cell& cell, double length) {
    for (std::uint64_t o = 0; o < 8; ++o) {
      const Vec3 corner = cell.center + 2 * (cell.child(o).center - cell.center);
      if (kLeastShare * length_at(corner) > length) return true;
    }
    return false;
  }
  double length_at(Vec3 x) { return field_.OctreeField::size(x, hint_) / field_.data().scale; }

  const OctreeField& field_;
  const OctreeView octree_;
  const SourceTree& sources_;
  RefineOptions options_;
  NodeLevels nodes_;
  std::int64_t n_added_ = 0;
  int hint_ = 0;
};

}  // namespace

OctreeShape refine_octree(const OctreeField& field, const RefineOptions& options) {
  ST_ASSERT(options.cell_per_length > 0);
  const OctreeView& octree = field.data().octree;
  OctreeShape fine{octree.lo, octree.edge, {}, {}, {}};
  if (!field.data().sources) {
    fine.leaf_keys.assign(octree.leaf_keys.begin(), octree.leaf_keys.end());
    fine.leaf_levels.assign(octree.leaf_levels.begin(), octree.leaf_levels.end());
    fine.node_children.assign(octree.node_children.begin(), octree.node_children.end());
    return fine;
  }
  NodeLevels nodes = Refinement(field, options).split();
  close_nodes(nodes);
  link_tree(nodes, fine);
  return fine;
}

ShownOctree show_octree(const OctreeField& field) {
  const OctreeFieldData& data = field.data();
  ShownOctree shown{refine_octree(field), {}, {}, {}};
  const OctreeView octree = shown.shape.view();
  int hint = 0;
  for (std::int32_t i = 0; i < octree.n_leaves(); ++i) {
    const std::int32_t leaf = data.octree.find_leaf(octree.leaf_keys[i]);
    shown.leaf.push_back(leaf);
    shown.length.push_back(data.cells[leaf].at_centre());
    shown.cause.push_back(data.cause[leaf]);
    if (!data.sources) continue;
    Vec3 gradient;
    const double length = field.size_and_gradient(octree.leaf_center(i), hint, gradient, shown.cause.back());
    shown.length.back() = static_cast<float>(length / data.scale);
  }
  return shown;
}

}  // namespace st
