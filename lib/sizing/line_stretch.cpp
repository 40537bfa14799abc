#include "sizing/line_stretch.h"

#include <algorithm>
#include <cmath>

namespace st {

SampleStretch stretch_along(const std::function<Vec3(double)>& point_at, double share, double way, double across,
                            const StretchLimits& limits) {
  constexpr double kSagitta = 0.15;  // of the length across: rows that bend more would run into each other
  constexpr double kShorter = 0.7;   // next length to try
  if (!(way > 0)) return {};         // a point has no direction
  for (double along = std::min(limits.max_length, limits.max_aspect * across); along > kLeastStretch * across;
       along *= kShorter) {
    const double step = std::min(along / way, 0.5), middle = std::clamp(share, step, 1 - step);
    const Vec3 a = point_at(middle - step), b = point_at(middle), c = point_at(middle + step);
    const double turning = angle_between(b - a, c - b);
    if (turning <= limits.alpha && turning * along <= 8 * kSagitta * across)
      return {SmallNormal(normalized(c - a)), static_cast<float>(along)};
  }
  return {};
}

}  // namespace st
