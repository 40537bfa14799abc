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

/// Stores a length where it is less; equal ones take the smaller cause.
void lower(RasterOctree& octree, std::int32_t site, double value, std::int32_t from) {
  const auto length = static_cast<float>(value);
  float& stored = octree.stored_length[static_cast<std::size_t>(site)];
  std::int32_t& cause = octree.stored_cause[static_cast<std::size_t>(site)];
  if (length > stored || (length == stored && from >= cause)) return;
  stored = length;
  cause = from;
}

/// Whether a sample lies on the surface of this part of a split leaf; of both where its normal does not tell.
bool concerns(const LengthSample& s, const Blanking& blanking, std::int32_t split, bool is_second) {
  constexpr double kClear = 0.3;  // cosine between the normals of sample and split
  const float* n = blanking.split[static_cast<std::size_t>(split)].normal;
  const double along = blanking.flow_along_normals * dot(Vec3(s.normal), Vec3{n[0], n[1], n[2]});
  return is_second ? along < kClear : along > -kClear;
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

  /// Lowers a cell of the leaf by those of its samples that `is_wanted` takes.
  template <class IsWanted>
  void hold(std::size_t leaf, const IsWanted& is_wanted, CellLength& cell) const {
    double excess = 0;
    float smallest = std::numeric_limits<float>::infinity();
    for (std::int32_t k = first_[leaf]; k < first_[leaf + 1]; ++k) {
      const LengthSample& s = samples_[by_leaf_[k]];
      if (!is_wanted(s)) continue;
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

 private:
  const OctreeView& octree_;
  std::span<const LengthSample> samples_;
  std::vector<std::int32_t> first_;    // [n_leaves+1] into by_leaf_
  std::vector<std::int32_t> by_leaf_;  // [n_samples]
};

/// Seeds lengths on their side of a surface.
class SiteSeeder {
 public:
  SiteSeeder(double slope, const Blanking& blanking, const Neighbours& neighbours, RasterOctree& octree)
      : slope_(slope), blanking_(blanking), neighbours_(neighbours), octree_(octree), view_(octree.shape.view()) {}

  void seed(const LengthSample& s) {
    const std::int32_t leaf = view_.find_leaf(morton::encode(view_.grid_point(place_of(s))));
    for_parts(s, leaf, [&](std::int32_t site) {
      lower_at(site, s);
      for_each_link(&blanking_, neighbours_, site, [&](std::int32_t other, const CellStep&) { lower_near(other, s); });
    });
    // the surface may bulge a little into what is blanked: lengths do not pass from there
    if (blanking_.colour[leaf] != CellColour::kBlanked) return;
    neighbours_.for_each(leaf, [&](std::int32_t other, const CellStep&) {
      for_parts(s, other, [&](std::int32_t site) { lower_at(site, s); });
    });
  }

 private:
  std::int32_t leaf_of(std::int32_t site) const {
    return site < view_.n_leaves() ? site : blanking_.split_leaf[site - view_.n_leaves()];
  }
  /// Calls f(site) for the parts of the leaf on whose surface the sample lies.
  template <class F>
  void for_parts(const LengthSample& s, std::int32_t leaf, const F& f) const {
    const std::int32_t k = blanking_.find_split(leaf);
    if (k == kNone || concerns(s, blanking_, k, false)) f(leaf);
    if (k != kNone && concerns(s, blanking_, k, true)) f(view_.n_leaves() + k);
  }
  void lower_at(std::int32_t site, const LengthSample& s) {
    lower(octree_, site, s.length + slope_ * distance(place_of(s), view_.leaf_center(leaf_of(site))), s.cause);
  }
  /// Where the leaf comes within one length along each axis.
  void lower_near(std::int32_t site, const LengthSample& s) {
    const std::int32_t leaf = leaf_of(site);
    const Vec3 d = place_of(s) - view_.leaf_center(leaf);
    const double reach = 0.5 * view_.cell_edge(view_.leaf_levels[leaf]) + s.length;
    if (std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) <= reach) lower_at(site, s);
  }

  const double slope_;
  const Blanking& blanking_;
  const Neighbours& neighbours_;
  RasterOctree& octree_;
  const OctreeView view_;
};

}  // namespace

std::vector<LengthSample> sorted_samples(std::span<const RasterBox> boxes) {
  std::vector<LengthSample> samples;
  samples.reserve(boxes.size());
  const auto f = [](double x) { return static_cast<float>(x); };
  for (const RasterBox& b : boxes)
    samples.push_back({{f(b.center.x), f(b.center.y), f(b.center.z)}, b.length, b.cause, b.normal});
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
      lower(octree, leaf, s.length + slope * distance(x, center), s.cause);
    };
    visit_leaves(view, view.node_children.empty() ? ~0 : 0, view.lo + Vec3{half, half, half}, half, x, s.length, seed);
  }
}

void seed_lengths(std::span<const LengthSample> samples, double slope, const Blanking& blanking,
                  const Neighbours& neighbours, RasterOctree& octree) {
  SiteSeeder seeder(slope, blanking, neighbours, octree);
  for (const LengthSample& s : samples) seeder.seed(s);
}

void hold_samples(const OctreeView& octree, std::span<const LengthSample> samples, const Blanking* blanking,
                  ProlongedLengths& lengths) {
  if (samples.empty()) return;
  const Limits limits(octree, samples);
  for (std::size_t leaf = 0; leaf < lengths.cells.size(); ++leaf) {
    const bool is_split = lengths.cells[leaf].upper < 0;
    const std::int32_t k = is_split ? blanking->find_split(static_cast<std::int32_t>(leaf)) : kNone;
    limits.hold(
        leaf, [&](const LengthSample& s) { return !is_split || concerns(s, *blanking, k, false); },
        lengths.cells[leaf]);
    if (is_split)
      limits.hold(
          leaf, [&](const LengthSample& s) { return concerns(s, *blanking, k, true); }, lengths.second_cells[k]);
  }
}

}  // namespace st
