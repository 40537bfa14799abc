#include "geometry/facet/knife_sides.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "base/disjoint_sets.h"

namespace st {
namespace {

/// What a plane leaves of a triangle, as numbers of halves: one below and one above for each triangle.
struct Halves {
  std::array<std::int32_t, 2> number{kNone, kNone};

  Halves(std::int32_t triangle, double low, double high) {
    if (low < 0) number[0] = 2 * triangle;
    if (high > 0) number[1] = 2 * triangle + 1;
  }
};

Halves halves_at(std::int32_t triangle, const Corners& c, double ha, double hb, const std::vector<double>& height) {
  const auto [low, high] = std::minmax(ha, hb);
  if (low < 0 || high > 0) return {triangle, low, high};
  const auto [lowest, highest] = std::minmax({height[c[0]], height[c[1]], height[c[2]]});
  return {triangle, lowest, highest};
}

}  // namespace

KnifeSides::KnifeSides(const FacetPatch& patch) : patch_(patch) {
  struct RimSide {
    std::int32_t low, high, triangle;  ///< nodes of the mesh
    int k;
    bool operator<(const RimSide& o) const {
      return std::tie(low, high, triangle) < std::tie(o.low, o.high, o.triangle);
    }
  };
  std::vector<RimSide> rim;
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(patch.corners.size()); ++t)
    for (int k = 0; k < 3; ++k) {
      if (patch.neighbours[t][k] != kNone) continue;
      const auto [low, high] = std::minmax(patch.node[patch.corners[t][k]], patch.node[patch.corners[t][(k + 1) % 3]]);
      rim.push_back({low, high, t, k});
    }
  std::sort(rim.begin(), rim.end());
  const auto normal = [&](std::int32_t t) { return normalized(area_normal(patch.x, patch.corners[t])); };
  for (std::size_t i = 0; i + 1 < rim.size(); ++i) {
    const RimSide &s = rim[i], &o = rim[i + 1];
    if (s.low != o.low || s.high != o.high || dot(normal(s.triangle), normal(o.triangle)) > kKnife) continue;
    const Corners& c = patch.corners[s.triangle];
    sides_.push_back({s.triangle, o.triangle, c[s.k], c[(s.k + 1) % 3]});
  }
}

bool KnifeSides::are_parted_by(const std::vector<double>& height) const {
  DisjointSets pieces(2 * static_cast<std::int64_t>(patch_.corners.size()));
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(patch_.corners.size()); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::int32_t other = patch_.neighbours[t][k];
      if (other < t) continue;
      const double ha = height[patch_.corners[t][k]], hb = height[patch_.corners[t][(k + 1) % 3]];
      if (std::min(ha, hb) < 0) pieces.join(2 * t, 2 * other);
      if (std::max(ha, hb) > 0) pieces.join(2 * t + 1, 2 * other + 1);
    }
  double parted = 0, all = 0;
  for (const Side& s : sides_) {
    const double ha = height[s.a], hb = height[s.b], length = distance(patch_.x[s.a], patch_.x[s.b]);
    const Halves own = halves_at(s.triangle, patch_.corners[s.triangle], ha, hb, height),
                 others = halves_at(s.other, patch_.corners[s.other], ha, hb, height);
    bool meet = false;
    for (const std::int32_t i : own.number)
      for (const std::int32_t j : others.number)
        meet = meet || (i != kNone && j != kNone && pieces.find(i) == pieces.find(j));
    all += length;
    if (!meet) parted += length;
  }
  return 2 * parted >= all;
}

}  // namespace st
