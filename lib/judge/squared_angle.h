// Angles between normals, most of them small, without an inverse tangent.
#pragma once

#include <cmath>

#include "base/vec.h"

namespace st {

/// The squared angle between two vectors, rad^2; 0 where one is zero.
inline double squared_angle(Vec3 a, Vec3 b) {
  constexpr double kSmall = 0.1;  // of the squared sine: the series of asin^2 is exact to 5e-8 there
  const double s2 = norm2(cross(a, b)), cosine = dot(a, b), n2 = norm2(a) * norm2(b);
  if (!(n2 > 0)) return 0;
  const double q = s2 / n2;
  if (cosine > 0 && q < kSmall)
    return q * (1 + q * (1.0 / 3 + q * (8.0 / 45 + q * (4.0 / 35 + q * (128.0 / 1575 + q * (128.0 / 2079))))));
  const double angle = std::atan2(std::sqrt(s2), cosine);
  return angle * angle;
}

}  // namespace st
