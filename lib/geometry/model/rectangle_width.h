// How wide a face is.
#pragma once

#include <cmath>

namespace st {

/// Width of the rectangle of this area and perimeter: of a strip its width, of anything rounder than a square the
/// square's side.
inline double rectangle_width(double area, double perimeter) {
  const double half = 0.5 * perimeter, d = half * half - 4 * area;
  return d > 0 ? 2 * area / (half + std::sqrt(d)) : std::sqrt(area);
}

}  // namespace st
