#include "geometry/shape/curve.h"

#include <cmath>

#include "base/assert.h"

namespace st {

std::optional<double> Curve::foot_near(Vec3, double) const { return std::nullopt; }

double arc_length(const Curve& curve, double t0, double t1, int n_intervals) {
  ST_ASSERT(n_intervals >= 1);
  // 5-point Gauss-Legendre
  static constexpr double kX[5] = {0.0, -0.5384693101056831, 0.5384693101056831, -0.9061798459386640,
                                   0.9061798459386640};
  static constexpr double kW[5] = {0.5688888888888889, 0.4786286704993665, 0.4786286704993665, 0.2369268850561891,
                                   0.2369268850561891};
  double length = 0;
  const double step = (t1 - t0) / n_intervals;
  for (int i = 0; i < n_intervals; ++i) {
    const double middle = t0 + (i + 0.5) * step;
    for (int k = 0; k < 5; ++k) length += 0.5 * step * kW[k] * norm(curve.evaluate(middle + 0.5 * step * kX[k]).d1);
  }
  return length;
}

double curvature(const CurvePoint& p) {
  const double speed = norm(p.d1);
  return speed > 0 ? norm(cross(p.d1, p.d2)) / (speed * speed * speed) : 0.0;
}

}  // namespace st
