// Boxes of single precision, for trees of triangles: half of the memory of Box3. Most of a search is their comparisons,
// so these are done for all axes at once.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "base/four_floats.h"

namespace st {

struct FloatBox {
  std::array<float, 3> lo, hi;

  bool meets(const FloatBox& o) const;
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
static_assert(sizeof(FloatBox) == 6 * sizeof(float));

/// A box as it is in memory: its lower sides and one upper, and one lower and its upper sides.
struct BoxSides {
  FourFloats lower, upper;
  explicit BoxSides(const FloatBox& box) : lower(load_four(&box.lo[0])), upper(load_four(&box.lo[2])) {}
};

/// A box to be compared with many. Without branches: most pairs that are asked differ in an axis that nothing
/// foretells.
class ComparedBox {
 public:
  explicit ComparedBox(const FloatBox& box)
      : most_{box.hi[0], box.hi[1], box.hi[2], kInfinity}, least_{-kInfinity, box.lo[0], box.lo[1], box.lo[2]} {}
  bool meets(const FloatBox& o) const {
    const BoxSides other(o);
    return bits_of((other.lower <= most_) & (other.upper >= least_)) == 15;
  }

 private:
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();
  FourFloats most_, least_;  // of the BoxSides of what it meets
};

inline bool FloatBox::meets(const FloatBox& o) const { return ComparedBox(*this).meets(o); }

/// The box over many.
class BoxOverBoxes {
 public:
  explicit BoxOverBoxes(const FloatBox& first) : sides_(first) {}
  void add(const FloatBox& o) {
    const BoxSides other(o);
    sides_.lower = other.lower < sides_.lower ? other.lower : sides_.lower;
    sides_.upper = other.upper > sides_.upper ? other.upper : sides_.upper;
  }
  FloatBox box() const {
    return {{sides_.lower[0], sides_.lower[1], sides_.lower[2]}, {sides_.upper[1], sides_.upper[2], sides_.upper[3]}};
  }

 private:
  BoxSides sides_;
};

}  // namespace st
