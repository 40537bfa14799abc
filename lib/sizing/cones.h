// Which samples of the raster tell the length in which cell: the size field by the samples themselves.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sizing/blanking.h"
#include "sizing/neighbours.h"
#include "sizing/sample_seeds.h"

namespace st {

/// Four numbers that are computed with at once.
using Float4 [[gnu::vector_size(16)]] = float;

/// A place from the lower corner of the root as two numbers of single precision for each coordinate, so that
/// differences to other places are exact to single precision.
struct SplitPlace {
  Float4 high, low;  // the last of the four is zero

  explicit SplitPlace(Vec3 from_lo)
      : high{static_cast<float>(from_lo.x), static_cast<float>(from_lo.y), static_cast<float>(from_lo.z), 0},
        low{rest(from_lo.x), rest(from_lo.y), rest(from_lo.z), 0} {}

  /// All eight.
  const float* numbers() const { return reinterpret_cast<const float*>(this); }

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

  /// All thirteen.
  const float* numbers() const { return reinterpret_cast<const float*>(this); }
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
};

/// What edges along a direction may be longer by, at a cone's rectangle.
struct ConeStretch {
  float direction[3] = {0, 0, 0};  ///< unit; zero: none
  float along = 0;                 ///< length along it, model unit, above the cone's; 0: the same in all directions

  ConeStretch() = default;
  explicit ConeStretch(const SampleStretch& of_sample);
};

static_assert(sizeof(Cone) == 13 * sizeof(float));
static_assert(sizeof(ConeStretch) == 4 * sizeof(float));

inline Cone::Cone(const LengthSample& sample, float slope, Vec3 lo) : length(sample.length), slope(slope) {
  const Vec3 from_lo = sample.xyz - lo;
  const double place[3] = {from_lo.x, from_lo.y, from_lo.z};
  const float(*reach[2])[3] = {&sample.reach.u, &sample.reach.v};
  for (int e = 0; e < 2; ++e) {
    const float(&r)[3] = *reach[e];
    half[e] = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
    for (int k = 0; k < 3; ++k) side[e][k] = half[e] > 0 ? r[k] / half[e] : 0;
  }
  for (int k = 0; k < 3; ++k) x[k] = static_cast<float>(place[k]);
}

inline ConeStretch::ConeStretch(const SampleStretch& of_sample) {
  if (!(of_sample.along > 0)) return;
  const Vec3 unit = normalized(Vec3(of_sample.direction));
  along = of_sample.along;
  direction[0] = static_cast<float>(unit.x);
  direction[1] = static_cast<float>(unit.y);
  direction[2] = static_cast<float>(unit.z);
}

struct SampleSites;

/// What ConeTable has, without what is not stored.
struct ConeView {
  std::span<const Cone> cone;
  std::span<const std::int32_t> cause, first, of_site;
  std::span<const ConeStretch> stretch;
  std::span<const std::int32_t> first_along, along_of_site;

  bool empty() const { return first.empty(); }
};

/// The cones of an octree, and which of them tell the length in each site.
struct ConeTable {
  std::vector<Cone> cone;               ///< those that tell any, by leaf
  std::vector<std::int32_t> cause;      ///< [cones]
  std::vector<std::int32_t> first;      ///< [n_sites + 1] into `of_site`; empty: there are no cones
  std::vector<std::int32_t> of_site;    ///< cones, those of the shortest lengths first for each site
  std::vector<std::int32_t> sample;     ///< [cones] which sample it is; not stored
  std::vector<std::int32_t> at_center;  ///< [n_sites] the cone that tells the length there; kNone: the largest
                                        ///< length. Not stored
  // Of add_stretch(); empty: lengths are the same in all directions.
  std::vector<ConeStretch> stretch;         ///< [cones]
  std::vector<std::int32_t> first_along;    ///< [n_sites + 1] into `along_of_site`
  std::vector<std::int32_t> along_of_site;  ///< cones that tell lengths along besides those of the site, in such order

  ConeView view() const { return {cone, cause, first, of_site, stretch, first_along, along_of_site}; }
};

/// The cones that tell the smallest of length + slope * distance, bounded by `max_length` (model unit, > 0), in each
/// site: those that win at its corners or its centre, and those nearby that win where the site is closest to them. A
/// sample reaches the sites to which links lead from its own, over sites where it wins: where it wins is star-shaped
/// about its rectangle (additively weighted Voronoi cells), so without a surface nothing is lost. With `blanking` (may
/// be null) only open links lead on. `slope` [n_samples] > 0. `sites` (may be null) becomes what add_stretch() needs.
/// Local, the same on every run. O(cones) in practice.
ConeTable spread_cones(const Neighbours& neighbours, std::span<const LengthSample> samples,
                       std::span<const float> slope, double max_length, const Blanking* blanking,
                       SampleSites* sites = nullptr);

}  // namespace st
