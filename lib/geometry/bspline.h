// B-spline curves and surfaces in local power basis: the inner loop's evaluators.
// Each knot span is a polynomial in s in [-1,1]; spans are converted when first met and kept (FACTS: 20-50 ns against 80-300 ns).
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/curve.h"
#include "geometry/surface.h"

namespace st {

/// Knots of one parameter direction, non-periodic, with the polynomial form of the basis functions of each span.
class KnotSpans {
 public:
  /// `flat_knots`: non-decreasing, n_poles + degree + 1 values; `period` > 0 wraps parameters into the knot range.
  KnotSpans(int degree, std::vector<double> flat_knots, double period);

  int degree() const { return degree_; }
  int n_spans() const { return static_cast<int>(start_.size()); }
  /// Span that holds `t` (wrapped; clamped to the first and last), `s` its local parameter. `last` is the caller's cache.
  int locate(double t, int& last, double& s) const;
  /// First pole that acts on a span.
  int first_pole(int span) const { return first_pole_[span]; }
  /// ds/dt of a span.
  double rate(int span) const { return rate_[span]; }
  /// Coefficient matrix [(degree+1)][(degree+1)]: row j = power coefficients of the j-th acting basis function.
  const double* basis(int span) const { return &basis_[static_cast<std::size_t>(span) * (degree_ + 1) * (degree_ + 1)]; }
  /// Interior knots where the spline is only C0 (multiplicity >= degree), ascending.
  const std::vector<double>& c0_knots() const { return c0_knots_; }

 private:
  int degree_;
  double period_, lo_, hi_;
  std::vector<double> start_, end_, middle_, rate_;
  std::vector<int> first_pole_;
  std::vector<double> basis_;
  std::vector<double> c0_knots_;
};

/// A pole in homogeneous coordinates: (w x, w y, w z, w).
struct Pole {
  double x[4];
};

class BsplineCurve : public Curve {
 public:
  BsplineCurve(KnotSpans knots, const std::vector<Pole>& poles, bool is_rational, double t_min, double t_max);
  Vec3 point(double t) const override;
  CurvePoint evaluate(double t) const override;
  const std::vector<double>& c0_knots() const { return knots_.c0_knots(); }

 private:
  KnotSpans knots_;
  bool is_rational_;
  std::vector<Pole> coefficients_;  // [span][degree+1]
  mutable int last_ = 0;
};

class BsplineSurface : public Surface {
 public:
  struct Bounds {
    double u_min, u_max, v_min, v_max;
  };
  /// `poles` [n_u][n_v], v fastest.
  BsplineSurface(KnotSpans u, KnotSpans v, std::vector<Pole> poles, int n_v, bool is_rational, Bounds bounds);
  Vec3 point(Vec2 uv) const override;
  SurfacePoint evaluate(Vec2 uv) const override;
  SurfacePoint2 evaluate2(Vec2 uv) const override;

 private:
  const Pole* patch(int iu, int iv) const;

  KnotSpans u_, v_;
  std::vector<Pole> poles_;
  int n_v_;
  bool is_rational_;
  mutable std::vector<std::int32_t> patch_index_;  // [n_spans_u][n_spans_v], -1 until met
  mutable std::vector<Pole> patches_;
  mutable int last_u_ = 0, last_v_ = 0;
};

}  // namespace st
