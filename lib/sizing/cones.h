// Which samples of the raster tell the length in which cell: the size field by the samples themselves.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "sizing/blanking.h"
#include "sizing/neighbours.h"
#include "sizing/sample_seeds.h"

namespace st {

/// Four numbers that are computed with at once.
using Float4 [[gnu::vector_size(16)]] = float;

/// A place from the lower corner of the root as two numbers of single precision for each coordinate, so that
/// differences to other places are exact to single precision. The last of the four is zero.
struct SplitPlace {
  Float4 high, low;

  explicit SplitPlace(Vec3 from_lo)
      : high{static_cast<float>(from_lo.x), static_cast<float>(from_lo.y), static_cast<float>(from_lo.z), 0},
        low{rest(from_lo.x), rest(from_lo.y), rest(from_lo.z), 0} {}

 private:
  static float rest(double x) { return static_cast<float>(x - static_cast<double>(static_cast<float>(x))); }
};

/// A sample asks for `length` on a rectangle around its place; from there lengths grow by its slope in all directions.
struct Cone {
  float x[3] = {0, 0, 0};  ///< from the lower corner of the octree's root, model unit
  float length = 0;        ///< model unit, > 0
  float slope = 0;         ///< change of length per distance, > 0
  float side[2][3] = {};   ///< unit vectors along the sides of the rectangle, or zero
  float half[2] = {};      ///< half the sides, model unit, >= 0

  Cone() = default;
  /// `lo`: the lower corner of the octree's root.
  Cone(const LengthSample& sample, float slope, Vec3 lo);

  /// From the closest point of the rectangle to `to`, which counts from the lower corner of the root.
  Vec3 way_to(Vec3 to) const {
    Vec3 way = to - Vec3{x[0], x[1], x[2]};
    for (int k = 0; k < 2; ++k) {
      const Vec3 e{side[k][0], side[k][1], side[k][2]};
      way -= std::clamp<double>(dot(way, e), -half[k], half[k]) * e;
    }
    return way;
  }
  /// Model unit.
  double length_at(Vec3 to) const { return length + slope * norm(way_to(to)); }
  /// Likewise in single precision, 1e-6 of the result.
  float length_at(const SplitPlace& to) const {
    Float4 way = in_space((to.high - load(offsetof(Cone, x))) + to.low);
    for (int k = 0; k < 2; ++k) {
      const Float4 e = load(offsetof(Cone, side) + static_cast<std::size_t>(k) * sizeof side[0]), along = sum(way * e),
                   most = half[k] - Float4{};
      const Float4 below = along < most ? along : most;
      way = in_space(way - (below > -most ? below : -most) * e);
    }
    return length + slope * std::sqrt(sum(way * way)[0]);
  }

 private:
  /// Four of its numbers; three of them are those of a vector.
  Float4 load(std::size_t offset) const {
    Float4 four;
    std::memcpy(&four, reinterpret_cast<const char*>(this) + offset, sizeof four);
    return four;
  }
  static Float4 in_space(Float4 v) { return __builtin_shufflevector(v, Float4{}, 0, 1, 2, 4); }
  /// In each of the four.
  static Float4 sum(Float4 v) {
    v += __builtin_shufflevector(v, v, 2, 3, 0, 1);
    return v + __builtin_shufflevector(v, v, 1, 0, 3, 2);
  }
};

/// The cones of an octree, and which of them tell the length in each site.
struct ConeTable {
  std::vector<Cone> cone;             ///< those that tell any, by leaf
  std::vector<std::int32_t> cause;    ///< [cones]
  std::vector<std::int32_t> first;    ///< [n_sites + 1] into `of_site`; empty: there are no cones
  std::vector<std::int32_t> of_site;  ///< cones, those of the shortest lengths first for each site
};

/// The cones that tell the smallest of length + slope * distance, bounded by `max_length` (model unit, > 0), in each
/// site: those that win at its corners or its centre, and those nearby that win where the site is closest to them. A
/// sample reaches the sites to which links lead from its own, over sites where it wins: where it wins is star-shaped
/// about its rectangle (additively weighted Voronoi cells), so without a surface nothing is lost. With `blanking` (may
/// be null) only open links lead on. `slope` [n_samples] > 0. Local, the same on every run. O(cones) in practice.
ConeTable spread_cones(const Neighbours& neighbours, std::span<const LengthSample> samples,
                       std::span<const float> slope, double max_length, const Blanking* blanking);

}  // namespace st
