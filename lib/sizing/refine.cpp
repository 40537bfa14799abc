#include "sizing/refine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/assert.h"
#include "base/error.h"
#include "sizing/octree_nodes.h"

namespace st {
namespace {

constexpr double kLargestChange = 1.5;  // of the length over a cell where it has detail, as a factor
constexpr double kLargestBend = 0.1;    // by which the length at the centre may miss the mean across, of the length
constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

Cell root_cell(const OctreeView& octree) {
  return {0, 0, octree.lo + Vec3{0.5 * octree.edge, 0.5 * octree.edge, 0.5 * octree.edge}, octree.edge};
}

/// Sources that matter in a cell, and the bounds of the smallest of their lengths there.
struct ActiveSources {
  std::vector<std::int32_t> index;
  double lo = kInfinity, hi = kInfinity;
  bool has_detail = false;
};

class Refinement {
 public:
  Refinement(const RasterOctree& raster, std::span<const NamedSource> sources, const RefineOptions& options)
      : raster_(raster), octree_(raster.shape.view()), sources_(sources), options_(options) {}

  /// All inner cells: the octree's, and where sources ask for more.
  NodeLevels split() {
    collect(octree_.node_children.empty() ? ~0 : 0, root_cell(octree_), all());
    return std::move(nodes_);
  }

  ActiveSources all() const {
    ActiveSources active;
    for (std::size_t i = 0; i < sources_.size(); ++i) active.index.push_back(static_cast<std::int32_t>(i));
    return active;
  }

  /// Drops sources that ask for nothing here, or for more than another one surely does.
  ActiveSources select(const Cell& cell, const ActiveSources& from) const {
    struct Candidate {
      std::int32_t index;
      SizeRange range;
    };
    std::vector<Candidate> candidates;
    ActiveSources active;
    active.hi = options_.max_length;
    double in_all_directions = options_.max_length;  // no edge is longer
    for (const std::int32_t i : from.index) {
      const SizeSource& source = *sources_[i].source;
      const SizeRange range = source.range(cell.center, 0.5 * cell.edge);
      if (!(range.lo < options_.max_length)) continue;
      candidates.push_back({i, range});
      if (!source.is_everywhere()) continue;
      active.hi = std::min(active.hi, range.hi);  // a bound for all of the cell
      in_all_directions = std::min(in_all_directions, source.max_aspect() * range.hi);
    }
    double highest = 0;
    for (const auto& [i, range] : candidates) {
      if (range.lo > in_all_directions) continue;
      active.index.push_back(i);
      active.lo = std::min(active.lo, range.lo);
      active.has_detail |= range.has_detail;
      highest = std::max(highest, range.hi);
    }
    active.hi = std::min(active.hi, highest);
    return active;
  }

  bool is_coarse(const Cell& cell, const ActiveSources& active) const {
    return !active.index.empty() && cell.level < kMaxLevel && cell.edge > options_.cell_per_length * active.lo &&
           active.hi > kLargestChange * active.lo && (active.has_detail || is_bent(cell, active));
  }

 private:
  void collect(std::int32_t node, const Cell& cell, const ActiveSources& from) {
    const ActiveSources active = from.index.empty() ? ActiveSources{} : select(cell, from);
    if (node < 0) return split_leaf(cell, active, static_cast<double>(raster_.stored_length[~node]));
    nodes_[cell.level].push_back(cell.key);
    for (std::uint64_t o = 0; o < 8; ++o)
      collect(octree_.node_children[8 * static_cast<std::size_t>(node) + o], cell.child(o), active);
  }

  /// `stored`: what the raster asks for there already.
  void split_leaf(const Cell& cell, ActiveSources active, double stored) {
    active.hi = std::min(active.hi, stored);
    if (!is_coarse(cell, active)) return;
    nodes_[cell.level].push_back(cell.key);
    require_few();
    for (std::uint64_t o = 0; o < 8; ++o) split_leaf(cell.child(o), select(cell.child(o), active), stored);
  }

  /// Smallest length at a point.
  double length_at(Vec3 x, const ActiveSources& active) const {
    double length = options_.max_length;
    for (const std::int32_t i : active.index)
      if (const SizeSource& source = *sources_[i].source; source.covers(x)) length = std::min(length, source.size(x));
    return length;
  }

  /// Whether a linear function misses the lengths in the cell.
  bool is_bent(const Cell& cell, const ActiveSources& active) const {
    const double middle = length_at(cell.center, active), half = 0.5 * cell.edge;
    for (const Vec3& d : {Vec3{half, 0, 0}, Vec3{0, half, 0}, Vec3{0, 0, half}}) {
      const double mean = 0.5 * (length_at(cell.center + d, active) + length_at(cell.center - d, active));
      if (std::abs(mean - middle) > kLargestBend * middle) return true;
    }
    return false;
  }

  void require_few() {
    if (7 * ++n_added_ + octree_.n_leaves() > options_.max_leaves)
      throw Error(ExitCode::kUsage, "sources: need more than " + std::to_string(options_.max_leaves) +
                                        " cells; make their lengths larger or the sources smaller");
  }

  const RasterOctree& raster_;
  const OctreeView octree_;
  std::span<const NamedSource> sources_;
  RefineOptions options_;
  NodeLevels nodes_;
  std::int64_t n_added_ = 0;
};

/// Lengths of the coarse octree's leaves for the finer one's.
void inherit_lengths(const RasterOctree& coarse, RasterOctree& fine) {
  std::size_t from = 0;
  const auto& ends = coarse.shape.leaf_keys;
  for (const std::uint64_t key : fine.shape.leaf_keys) {
    while (from + 1 < ends.size() && ends[from + 1] <= key) ++from;
    fine.stored_length.push_back(coarse.stored_length[from]);
    fine.stored_cause.push_back(coarse.stored_cause[from]);
  }
}

/// Second walk: the smallest length of the sources in each leaf.
class SourceStore {
 public:
  SourceStore(const Refinement& refinement, std::span<const NamedSource> sources, RasterOctree& octree,
              std::vector<SourceRequest>* requests)
      : refinement_(refinement), sources_(sources), octree_(octree), view_(octree.shape.view()), requests_(requests) {}

  void store() { visit(view_.node_children.empty() ? ~0 : 0, root_cell(view_), refinement_.all()); }

 private:
  void visit(std::int32_t node, const Cell& cell, const ActiveSources& from) {
    const ActiveSources active = refinement_.select(cell, from);
    if (active.index.empty()) return;
    if (node < 0) return store(~node, cell, active);
    for (std::uint64_t o = 0; o < 8; ++o)
      visit(view_.node_children[8 * static_cast<std::size_t>(node) + o], cell.child(o), active);
  }

  void store(std::int32_t leaf, const Cell& cell, const ActiveSources& active) {
    const bool any_covers = std::any_of(active.index.begin(), active.index.end(),
                                        [&](std::int32_t i) { return sources_[i].source->covers(cell.center); });
    for (const std::int32_t i : active.index) {
      const SizeSource& source = *sources_[i].source;
      if (any_covers && !source.covers(cell.center)) continue;
      const SizeRange range = source.range(cell.center, 0.5 * cell.edge);
      const auto length = static_cast<float>(range.meets_core ? range.lo : source.size(cell.center));
      if (requests_) requests_->push_back({leaf, length, stretch_of(source, cell.center, length)});
      float& stored = octree_.stored_length[leaf];
      std::int32_t& cause = octree_.stored_cause[leaf];
      if (length > stored || (length == stored && sources_[i].cause >= cause)) continue;
      stored = length;
      cause = sources_[i].cause;
    }
  }

  /// As at the place, where the length may be another.
  static SampleStretch stretch_of(const SizeSource& source, Vec3 x, float length) {
    int hint = 0;
    const LocalSize local = source.local(x, hint);
    if (!(local.along > local.length)) return {};
    return {SmallNormal(local.direction), static_cast<float>(length * (local.along / local.length))};
  }

  const Refinement& refinement_;
  std::span<const NamedSource> sources_;
  RasterOctree& octree_;
  OctreeView view_;
  std::vector<SourceRequest>* requests_;
};

}  // namespace

RasterOctree refine_octree(const RasterOctree& raster, std::span<const NamedSource> sources,
                           const RefineOptions& options, std::vector<SourceRequest>* requests) {
  ST_ASSERT(options.max_length > 0 && options.cell_per_length > 0);
  Refinement refinement(raster, sources, options);
  NodeLevels nodes = refinement.split();
  close_nodes(nodes);
  RasterOctree fine;
  fine.shape.lo = raster.shape.lo;
  fine.shape.edge = raster.shape.edge;
  link_tree(nodes, fine.shape);
  inherit_lengths(raster, fine);
  SourceStore(refinement, sources, fine, requests).store();
  return fine;
}

}  // namespace st
