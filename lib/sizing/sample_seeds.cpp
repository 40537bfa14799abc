#include "sizing/sample_seeds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "base/limits.h"

namespace st {
namespace {

Vec3 place_of(const LengthSample& s) { return {s.xyz[0], s.xyz[1], s.xyz[2]}; }

/// Calls f(leaf, centre) for every leaf that comes within `reach` of x along each axis.
template <class F>
void visit_leaves(const OctreeView& octree, std::int32_t node, Vec3 middle, double half, Vec3 x, double reach,
                  const F& f) {
  const Vec3 d = x - middle;
  if (std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) > half + reach) return;
  if (node < 0) return f(~node, middle);
  const double quarter = 0.5 * half;
  for (std::size_t o = 0; o < 8; ++o)
    visit_leaves(octree, octree.node_children[8 * static_cast<std::size_t>(node) + o],
                 {middle.x + (o & 1 ? quarter : -quarter), middle.y + (o & 2 ? quarter : -quarter),
                  middle.z + (o & 4 ? quarter : -quarter)},
                 quarter, x, reach, f);
}

/// Samples by the leaf in which they lie.
class Limits {
 public:
  Limits(const OctreeView& octree, std::span<const LengthSample> samples) : octree_(octree), samples_(samples) {
    require_countable(samples.size(), "samples of the raster");
    std::vector<std::int32_t> leaf_of;
    first_.assign(octree.leaf_keys.size() + 1, 0);
    for (const LengthSample& s : samples) {
      leaf_of.push_back(octree.find_leaf(morton::encode(octree.grid_point(place_of(s)))));
      ++first_[static_cast<std::size_t>(leaf_of.back()) + 1];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    by_leaf_.resize(samples.size());
    std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < leaf_of.size(); ++i) by_leaf_[next[leaf_of[i]]++] = static_cast<std::int32_t>(i);
  }

  /// Lowers each cell; `leaf_of` says which leaf it belongs to.
  template <class LeafOf>
  void hold(std::span<CellLength> cells, const LeafOf& leaf_of) const {
    for (std::size_t i = 0; i < cells.size(); ++i) hold_cell(leaf_of(i), cells[i]);
  }

 private:
  void hold_cell(std::size_t leaf, CellLength& cell) const {
    double excess = 0;
    float smallest = std::numeric_limits<float>::infinity();
    for (std::int32_t k = first_[leaf]; k < first_[leaf + 1]; ++k) {
      const LengthSample& s = samples_[by_leaf_[k]];
      const Vec3 d = place_of(s) - octree_.leaf_center(static_cast<std::int32_t>(leaf));
      excess = std::max(
          excess, cell.length + cell.gradient[0] * d.x + cell.gradient[1] * d.y + cell.gradient[2] * d.z - s.length);
      smallest = std::min(smallest, s.length);
    }
    if (!(excess > 0)) return;
    cell.length -= static_cast<float>(excess);
    if (cell.length >= smallest) return;
    cell.length = smallest;  // nothing asks for less
    std::fill_n(cell.gradient, 3, 0.0F);
  }

  const OctreeView& octree_;
  std::span<const LengthSample> samples_;
  std::vector<std::int32_t> first_;    // [n_leaves+1] into by_leaf_
  std::vector<std::int32_t> by_leaf_;  // [n_samples]
};

}  // namespace

std::vector<LengthSample> sorted_samples(std::span<const RasterBox> boxes) {
  std::vector<LengthSample> samples;
  samples.reserve(boxes.size());
  const auto f = [](double x) { return static_cast<float>(x); };
  for (const RasterBox& b : boxes)
    samples.push_back({{f(b.center.x), f(b.center.y), f(b.center.z)}, b.length, b.cause});
  const auto key = [](const LengthSample& s) { return std::tuple(s.cause, s.xyz[0], s.xyz[1], s.xyz[2], s.length); };
  std::sort(samples.begin(), samples.end(),
            [&](const LengthSample& a, const LengthSample& b) { return key(a) < key(b); });
  return samples;
}

void forget_samples(RasterOctree& octree) {
  for (std::size_t leaf = 0; leaf < octree.stored_cause.size(); ++leaf) {
    std::int32_t& cause = octree.stored_cause[leaf];
    if (cause == kNone || (cause_kind(cause) != CauseKind::kEdge && cause_kind(cause) != CauseKind::kFace)) continue;
    octree.stored_length[leaf] = std::numeric_limits<float>::infinity();
    cause = kNone;
  }
}

void seed_lengths(std::span<const LengthSample> samples, double slope, RasterOctree& octree) {
  const OctreeView view = octree.shape.view();
  const double half = 0.5 * view.edge;
  for (const LengthSample& s : samples) {
    const Vec3 x = place_of(s);
    const auto seed = [&](std::int32_t leaf, Vec3 center) {
      const auto length = static_cast<float>(s.length + slope * distance(x, center));
      float& stored = octree.stored_length[static_cast<std::size_t>(leaf)];
      std::int32_t& cause = octree.stored_cause[static_cast<std::size_t>(leaf)];
      if (length > stored || (length == stored && s.cause >= cause)) return;
      stored = length;
      cause = s.cause;
    };
    visit_leaves(view, view.node_children.empty() ? ~0 : 0, view.lo + Vec3{half, half, half}, half, x, s.length, seed);
  }
}

void hold_samples(const OctreeView& octree, std::span<const LengthSample> samples,
                  std::span<const std::int32_t> split_leaf, ProlongedLengths& lengths) {
  if (samples.empty()) return;
  Limits limits(octree, samples);
  limits.hold(lengths.cells, [](std::size_t cell) { return cell; });
  limits.hold(lengths.second_cells, [&](std::size_t part) { return static_cast<std::size_t>(split_leaf[part]); });
}

}  // namespace st
