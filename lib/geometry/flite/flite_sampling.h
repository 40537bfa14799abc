// Points through which a composite Ferguson curve or surface follows any other one.
#pragma once

#include <vector>

#include "geometry/shape/curve.h"
#include "geometry/shape/surface.h"

namespace st {

struct SampledCurve {
  std::vector<Vec3> points;
  double deviation = 0;  ///< largest distance found (model unit)
};

/// As few points as keep the Ferguson curve within `tolerance` of `curve` from t0 to t1, closer to each other at the
/// ends, where it has no curvature. Its ends are `start` and `end`: the curve is bent to them where they are a little
/// off. Where hundreds of points do not suffice, `deviation` says so.
SampledCurve sample_curve(const Curve& curve, double t0, double t1, Vec3 start, Vec3 end, double tolerance);

struct SampledSurface {
  int n_u = 2, n_v = 2;
  std::vector<Vec3> points;  ///< [n_v][n_u], u fastest
  double deviation = 0;      ///< largest distance found, off the surface (model unit)
};

/// As sample_curve(), for the surface over its bounds; a plane by 2 x 2 points, a tenth larger than its bounds.
SampledSurface sample_surface(const Surface& surface, double tolerance);

}  // namespace st
