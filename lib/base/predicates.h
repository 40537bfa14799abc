// Exact predicates: the sign of a determinant is right whatever the rounding. A filter decides nearly always (inline);
// the rest is evaluated with floating-point expansions (Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast
// Robust Geometric Predicates, 1997).
//
// Range: exact as long as no product of coordinate differences overflows or underflows: differences that are zero or
// between 1e-70 and 1e+70 in absolute value. Coordinates must be finite. Compile with -ffp-contract=off.
#pragma once

#include <cmath>
#include <limits>

#include "base/vec.h"

namespace st {

namespace detail {
inline constexpr double kHalfUlp = std::numeric_limits<double>::epsilon() / 2;
inline constexpr double kOrient2dBound = (3 + 16 * kHalfUlp) * kHalfUlp;
inline constexpr double kOrient3dBound = (7 + 56 * kHalfUlp) * kHalfUlp;
double orient2d_exact(Vec2 a, Vec2 b, Vec2 c);
double orient3d_exact(Vec3 a, Vec3 b, Vec3 c, Vec3 d);
}  // namespace detail

/// orient2d(a, b, c) where ac = a - c and bc = b - c are at hand.
inline double orient2d_between(Vec2 ac, Vec2 bc, const Vec2& a, const Vec2& b, const Vec2& c) {
  const double left = ac.x * bc.y, right = ac.y * bc.x;
  const double det = left - right;
  const double bound = detail::kOrient2dBound * (std::fabs(left) + std::fabs(right));
  return det >= bound || -det >= bound ? det : detail::orient2d_exact(a, b, c);
}

/// Twice the signed area of the triangle (a, b, c): positive when counter-clockwise, zero exactly when collinear. The
/// sign is exact, the magnitude approximate. Swapping two arguments flips the sign exactly.
inline double orient2d(Vec2 a, Vec2 b, Vec2 c) { return orient2d_between(a - c, b - c, a, b, c); }

/// Six times the signed volume of the tetrahedron (a, b, c, d), ((b-a) x (c-a)) . (d-a): positive when d lies on the
/// side that the normal of (a, b, c) points to, zero exactly when coplanar. The sign is exact, the magnitude
/// approximate. Swapping two arguments flips the sign.
inline double orient3d(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const Vec3 p = a - d, q = b - d, r = c - d;
  const double qxry = q.x * r.y, rxqy = r.x * q.y, rxpy = r.x * p.y, pxry = p.x * r.y, pxqy = p.x * q.y,
               qxpy = q.x * p.y;
  const double det = p.z * (rxqy - qxry) + q.z * (pxry - rxpy) + r.z * (qxpy - pxqy);
  const double permanent = (std::fabs(qxry) + std::fabs(rxqy)) * std::fabs(p.z) +
                           (std::fabs(rxpy) + std::fabs(pxry)) * std::fabs(q.z) +
                           (std::fabs(pxqy) + std::fabs(qxpy)) * std::fabs(r.z);
  const double bound = detail::kOrient3dBound * permanent;
  return det >= bound || -det >= bound ? det : detail::orient3d_exact(a, b, c, d);
}

}  // namespace st
