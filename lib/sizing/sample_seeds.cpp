#include "sizing/sample_seeds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>
#include <utility>

#include "base/parallel_reserve.h"
#include "base/radix_sort.h"
#include "base/threads.h"
#include "sizing/cone_site.h"

namespace st {
namespace {

constexpr double kClear = 0.3;  // cosine between the normals of a sample and of a surface: they look the same way

/// Whether a sample lies on the surface of this part of a split leaf; of both where its normal does not tell.
bool concerns(const LengthSample& s, const Blanking& blanking, std::int32_t split, bool is_second) {
  const float* n = blanking.split[static_cast<std::size_t>(split)].normal;
  const double along = blanking.flow_along_normals * dot(Vec3(s.normal), Vec3{n[0], n[1], n[2]});
  return is_second ? along < kClear : along > -kClear;
}

/// Finds the sites that a sample lies in, on its side of a surface.
template <class F>
class SiteVisitor {
 public:
  SiteVisitor(const OctreeView& octree, const Neighbours& neighbours, const Blanking& blanking, const F& f)
      : octree_(octree), neighbours_(neighbours), blanking_(blanking), f_(f) {}

  /// `leaf`: where the sample lies.
  void visit(const LengthSample& s, std::int32_t leaf) const {
    if (sheet_along(s, leaf) < -kClear && visit_own_sheet_beside(s, leaf)) return;
    visit_parts(s, leaf);
    if (blanking_.colour[leaf] != CellColour::kBlanked) return;
    // the surface may bulge a little into what is blanked: lengths do not pass from there. Around a leaf inside a thin
    // wall lies its other side, too
    neighbours_.for_each(leaf, [&](std::int32_t other, const CellStep&) {
      if (!(sheet_along(s, other) < -kClear)) visit_parts(s, other);
    });
  }

 private:
  /// Cosine between the normals of the sample and of the surface in the leaf; 0 where that is not one sheet.
  double sheet_along(const LengthSample& s, std::int32_t leaf) const {
    const std::int32_t cut = blanking_.cut_index[leaf];
    return cut == kNone ? 0 : blanking_.flow_along_normals * dot(Vec3(s.normal), blanking_.sheet[cut]);
  }

  /// A sample that lies a little off the surface, in a leaf that holds the other side of a thin wall alone: the parts
  /// of leaves beside it on whose surface it lies. Whether there are any.
  bool visit_own_sheet_beside(const LengthSample& s, std::int32_t leaf) const {
    bool has_any = false;
    neighbours_.for_each(leaf, [&](std::int32_t other, const CellStep&) {
      if (blanking_.find_split(other) == kNone && !(sheet_along(s, other) > kClear)) return;
      visit_parts(s, other);
      has_any = true;
    });
    return has_any;
  }

  /// A leaf with one sheet of the surface is not.
  bool may_be_split(std::int32_t leaf) const {
    return blanking_.colour[leaf] == CellColour::kCut && !(norm2(blanking_.sheet[blanking_.cut_index[leaf]]) > 0);
  }

  /// The parts of the leaf on whose surface the sample lies.
  void visit_parts(const LengthSample& s, std::int32_t leaf) const {
    const std::int32_t k = may_be_split(leaf) ? blanking_.find_split(leaf) : kNone;
    if (k == kNone || concerns(s, blanking_, k, false)) f_(leaf);
    if (k != kNone && concerns(s, blanking_, k, true)) f_(octree_.n_leaves() + k);
  }

  const OctreeView& octree_;
  const Neighbours& neighbours_;
  const Blanking& blanking_;
  const F& f_;
};

/// In single precision. A call of its own: GCC 12 forgets to round where it takes two coordinates at once.
[[gnu::noinline]] double in_single(double x) { return static_cast<float>(x); }

/// What tells samples apart, in their order.
auto key_of(const LengthSample& s) {
  return std::tuple(s.cause, s.xyz.x, s.xyz.y, s.xyz.z, s.length, s.stretch.along, s.reach.u[0], s.reach.u[1],
                    s.reach.u[2], s.reach.v[0], s.reach.v[1], s.reach.v[2]);
}

/// Of its rectangle, a little inside.
std::array<Vec3, 4> corners_of(const LengthSample& s) {
  constexpr double kInside = 0.9;
  const Vec3 u = kInside * Vec3{s.reach.u[0], s.reach.u[1], s.reach.u[2]},
             v = kInside * Vec3{s.reach.v[0], s.reach.v[1], s.reach.v[2]};
  return {s.xyz + u + v, s.xyz + u - v, s.xyz - u + v, s.xyz - u - v};
}

}  // namespace

Vec3 origin_of_places(const Box3& model) {
  constexpr double kFar = 16;  // largest sides of the box: there the steps are 1e-6 sides
  if (model.is_empty()) return {};
  const Vec3 side = model.hi - model.lo;
  double farthest = 0;
  for (const Vec3 x : {model.lo, model.hi})
    farthest = std::max({farthest, std::abs(x.x), std::abs(x.y), std::abs(x.z)});
  return farthest > kFar * std::max({side.x, side.y, side.z}) ? model.center() : Vec3{};
}

std::vector<LengthSample> sorted_samples(std::span<const RasterBox> boxes, Vec3 origin) {
  constexpr std::size_t kPerPiece = 2'048;  // samples
  const auto sample_of = [&](std::size_t i) {
    const RasterBox& b = boxes[i];
    const Vec3 x = b.center - origin;
    return LengthSample{
        origin + Vec3{in_single(x.x), in_single(x.y), in_single(x.z)}, b.length, b.cause, b.normal, b.stretch, b.reach};
  };
  struct Place {
    std::uint64_t key;  // what tells most apart: the cause, then x
    std::size_t i;
  };
  std::vector<Place> order(boxes.size()), other;
  parallel_for(boxes.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const LengthSample s = sample_of(i);
      order[i] = {std::uint64_t{sort_key(s.cause)} << 32 | sort_key(static_cast<float>(s.xyz.x)), i};
    }
  });
  radix_sort(order, other, [](const Place& p) { return p.key; });
  for (auto begin = order.begin(), end = begin; begin != order.end(); begin = end) {
    end = std::find_if(begin, order.end(), [&](const Place& p) { return p.key != begin->key; });
    std::sort(begin, end,
              [&](const Place& p, const Place& q) { return key_of(sample_of(p.i)) < key_of(sample_of(q.i)); });
  }
  std::vector<LengthSample> sorted;
  parallel_reserve(sorted, boxes.size());
  sorted.resize(boxes.size());
  parallel_for(boxes.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) sorted[i] = sample_of(order[i].i);
  });
  return sorted;
}

std::vector<LengthSample> merged_samples(std::vector<std::vector<LengthSample>> sorted) {
  const auto is_before = [](const LengthSample& a, const LengthSample& b) { return key_of(a) < key_of(b); };
  for (; sorted.size() > 1; sorted.erase(sorted.begin(), sorted.begin() + 2)) {
    std::vector<LengthSample>& both = sorted.emplace_back();
    both.reserve(sorted[0].size() + sorted[1].size());
    std::ranges::merge(sorted[0], sorted[1], std::back_inserter(both), is_before);
  }
  return sorted.empty() ? std::vector<LengthSample>() : std::move(sorted.front());
}

void for_each_own_site(const Neighbours& neighbours, std::span<const LengthSample> samples, const Blanking* blanking,
                       const std::function<void(std::int32_t, std::int32_t)>& f) {
  constexpr std::size_t kPerPiece = 2'048;  // samples
  const OctreeView& octree = neighbours.octree();
  const auto key_at = [&](Vec3 x) { return morton::encode(octree.grid_point(x)); };
  const auto for_each_site = [&](const LengthSample& sample, const auto& own) {
    const auto visit = [&](const LengthSample& s, std::int32_t leaf) {
      if (blanking)
        SiteVisitor(octree, neighbours, *blanking, own).visit(s, leaf);
      else
        own(leaf);
    };
    const std::int32_t leaf = octree.find_leaf(key_at(sample.xyz));
    visit(sample, leaf);
    if (sample.reach == SampleReach{}) return;
    for (const Vec3 corner : corners_of(sample))
      if (const std::uint64_t key = key_at(corner); !octree.leaf_contains(leaf, key)) {
        LengthSample moved = sample;
        moved.xyz = corner;
        visit(moved, octree.find_leaf(key));
      }
  };
  std::vector<std::vector<SiteSample>> found((samples.size() + kPerPiece - 1) / kPerPiece);
  parallel_for(samples.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
    std::vector<SiteSample>& own = found[begin / kPerPiece];
    own.reserve(4 * (end - begin));
    for (std::size_t i = begin; i < end; ++i)
      for_each_site(samples[i], [&](std::int32_t site) { own.push_back({site, static_cast<std::int32_t>(i)}); });
  });
  for (const std::vector<SiteSample>& piece : found)
    for (const SiteSample& own : piece) f(own.site, own.sample);
}

}  // namespace st
