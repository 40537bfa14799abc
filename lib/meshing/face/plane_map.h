// From (u,v) of a surface to the plane in which its face is triangulated.
#pragma once

#include <vector>

#include "geometry/shape/surface.h"

namespace st {

/// One coordinate: a step in the plane is about as long as in space.
class PlaneAxis {
 public:
  PlaneAxis() = default;
  /// By one factor.
  explicit PlaneAxis(double scale) : scale_(scale) {}
  /// By a factor that changes linearly between those at the ends of equal intervals of [lo, hi], at least two, > 0.
  PlaneAxis(double lo, double hi, std::vector<double> factors);

  double to_plane(double u) const { return factors_.empty() ? u * scale_ : integral(u); }
  double to_parameter(double p) const { return factors_.empty() ? p / scale_ : inverse(p); }
  /// Of a step in the plane to one of the parameter.
  double factor(double u) const;
  /// On the mean.
  double scale() const { return scale_; }

 private:
  std::size_t interval_of(double u) const;
  double integral(double u) const;
  double inverse(double p) const;

  double scale_ = 1, lo_ = 0, step_ = 0;
  std::vector<double> factors_;  // empty: scale_ everywhere
  std::vector<double> at_;       // of the plane, at the ends of the intervals
};

/// Both coordinates. Immutable once made.
struct PlaneMap {
  PlaneAxis u, v;

  PlaneMap() = default;
  /// By the mean lengths of the derivatives; along a coordinate in which they are very uneven, by those at each place.
  explicit PlaneMap(const Surface& surface);

  Vec2 to_plane(Vec2 uv) const { return {u.to_plane(uv.x), v.to_plane(uv.y)}; }
  Vec2 to_uv(Vec2 p) const { return {u.to_parameter(p.x), v.to_parameter(p.y)}; }
  Vec2 factors(Vec2 uv) const { return {u.factor(uv.x), v.factor(uv.y)}; }
  Vec2 scale() const { return {u.scale(), v.scale()}; }
};

}  // namespace st
