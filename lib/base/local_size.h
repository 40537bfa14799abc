// Requested lengths at a point that may be longer along a direction, and the linear map that makes them equal.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/vec.h"

namespace st {

/// The requested edge lengths at a point: `length` in every direction but `direction`, along which edges may be longer.
/// As a metric: length^-2 I - (length^-2 - along^-2) direction direction^T.
struct LocalSize {
  double length = 0;  ///< model unit, > 0
  double along = 0;   ///< model unit, >= length; equal: the same length in all directions
  Vec3 direction;     ///< unit; zero where both are equal

  /// Requested length of an edge along `d` (any length; zero: the smallest).
  double in(Vec3 d) const {
    const double d2 = norm2(d), part = dot(d, direction);
    if (!(along > length) || !(d2 > 0)) return length;
    const double share = std::min(1.0, part * part / d2), ratio = length / along;
    return length / std::sqrt(1 - share * (1 - ratio * ratio));
  }
  /// As one vector, see squeezed().
  Vec3 squeeze() const {
    const double ratio = length / along;
    return along > length ? std::sqrt(1 - ratio * ratio) * direction : Vec3{};
  }
};

/// Stretched sizes as one vector: along a unit vector t edges may be `aspect` times as long as across, squeeze =
/// t sqrt(1 - 1/aspect^2); zero where they may not. |d|^2 - (squeeze . d)^2 is the squared length of d as they see it.
inline Vec3 squeezed(Vec3 d, Vec3 squeeze) {
  const double across = std::sqrt(1 - norm2(squeeze));
  return d - (dot(squeeze, d) / (1 + across)) * squeeze;
}

/// Its inverse.
inline Vec3 unsqueezed(Vec3 d, Vec3 squeeze) {
  const double across = std::sqrt(1 - norm2(squeeze));
  return d + (dot(squeeze, d) / (across * (1 + across))) * squeeze;
}

}  // namespace st
