// Parametric curves in space, evaluated without knowing what they are.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "base/vec.h"

namespace st {

/// Position and derivatives of a space curve at one parameter.
struct CurvePoint {
  Vec3 x;       ///< position, model unit
  Vec3 d1, d2;  ///< first and second derivative by the parameter
};

/// A bounded parametric curve x(t), t in [t_min, t_max]. One object serves one thread: evaluators cache the last span.
class Curve {
 public:
  virtual ~Curve() = default;
  double t_min() const { return t_min_; }
  double t_max() const { return t_max_; }
  virtual Vec3 point(double t) const = 0;
  /// Position, first and second derivative.
  virtual CurvePoint evaluate(double t) const = 0;
  /// Parameters strictly inside the bounds where one polynomial piece ends and the next begins, ascending.
  virtual std::vector<double> knots() const { return {}; }
  /// What project_near() gives, of curves where Newton's method stalls (polylines); nullopt for all others.
  virtual std::optional<double> foot_near(Vec3 p, double guess) const;
  /// Another one of the same data, for any thread, at a fraction of the cost of making it; nullptr: there is no saving.
  virtual std::unique_ptr<Curve> copy() const { return nullptr; }
  /// Period of the parametrisation, 0 when there is none.
  double period() const { return period_; }

 protected:
  double t_min_ = 0, t_max_ = 1, period_ = 0;
};

/// A bounded trimming curve (u,v)(t) in a surface's parameter plane, with the same parameter as the edge's space curve.
class Curve2d {
 public:
  virtual ~Curve2d() = default;
  virtual Vec2 point(double t) const = 0;
};

/// Arc length of `curve` between two parameters (model unit), by Gauss quadrature on `n_intervals` equal parameter
/// intervals.
double arc_length(const Curve& curve, double t0, double t1, int n_intervals = 16);

/// Curvature (1/model unit, never negative); zero where the first derivative vanishes.
double curvature(const CurvePoint& p);

}  // namespace st
