// Boxes of single precision, for trees of triangles: half of the memory of Box3.
#pragma once

#include <algorithm>
#include <array>

namespace st {

struct FloatBox {
  std::array<float, 3> lo, hi;

  /// Without branches: most pairs that are asked differ in an axis that nothing foretells.
  bool meets(const FloatBox& o) const {
    return (lo[0] <= o.hi[0]) & (o.lo[0] <= hi[0]) & (lo[1] <= o.hi[1]) & (o.lo[1] <= hi[1]) & (lo[2] <= o.hi[2]) &
           (o.lo[2] <= hi[2]);
  }
  void add(const FloatBox& o) {
    for (int k = 0; k < 3; ++k) lo[k] = std::min(lo[k], o.lo[k]), hi[k] = std::max(hi[k], o.hi[k]);
  }
  /// The sum of its three sides.
  float extent() const { return (hi[0] - lo[0]) + (hi[1] - lo[1]) + (hi[2] - lo[2]); }
  int longest_axis() const {
    int axis = 0;
    for (int k = 1; k < 3; ++k)
      if (hi[k] - lo[k] > hi[axis] - lo[axis]) axis = k;
    return axis;
  }
};

}  // namespace st
