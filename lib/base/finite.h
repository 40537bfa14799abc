// Whether numbers and places are finite.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>

#include "base/vec.h"

namespace st {

template <std::floating_point T>
bool is_finite(T x) {
  return std::abs(x) <= std::numeric_limits<T>::max();  // false for NaN
}
inline bool is_finite(Vec2 x) { return is_finite(x.x) & is_finite(x.y); }
inline bool is_finite(Vec3 x) { return is_finite(x.x) & is_finite(x.y) & is_finite(x.z); }
inline bool is_finite(const Box3& box) { return is_finite(box.lo) & is_finite(box.hi); }
template <class T, std::size_t N>
bool is_finite(const std::array<T, N>& all) {
  return std::ranges::all_of(all, [](const T& x) { return is_finite(x); });
}

}  // namespace st
