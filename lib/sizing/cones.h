// Which samples of the raster tell the length in which cell: the size field by the samples themselves.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "sizing/blanking.h"
#include "sizing/neighbours.h"
#include "sizing/sample_seeds.h"

namespace st {

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
