// Curves through points by straight segments: feature lines of facets, and their traces in (u,v).
#pragma once

#include <span>
#include <vector>

#include "geometry/shape/curve.h"

namespace st {

/// Through two points or more, parametrised by arc length from 0. Derivatives are those of the smooth curve that the
/// segments stand for: tangents turn evenly from point to point, the second derivative is linear between them.
class PolylineCurve final : public Curve {
 public:
  explicit PolylineCurve(std::vector<Vec3> points);
  Vec3 point(double t) const override;
  CurvePoint evaluate(double t) const override;
  std::vector<double> knots() const override { return {t_.begin() + 1, t_.end() - 1}; }
  std::optional<double> foot_near(Vec3 p, double guess) const override;
  std::unique_ptr<Curve> copy() const override { return std::make_unique<PolylineCurve>(*this); }

 private:
  std::vector<Vec3> points_, tangent_, bend_;
  std::vector<double> t_;
};

/// The same parameters, other points.
class PolylineCurve2d final : public Curve2d {
 public:
  /// `t` ascending, as many as points, at least two.
  PolylineCurve2d(std::vector<double> t, std::vector<Vec2> points);
  Vec2 point(double t) const override;

 private:
  std::vector<double> t_;
  std::vector<Vec2> points_;
};

/// Arc length from the first point to each.
std::vector<double> polyline_parameters(std::span<const Vec3> points);

}  // namespace st
