// Coordinates by the number of their axis.
#pragma once

#include "base/vec.h"

namespace st {

/// `axis`: 0, 1, 2 for x, y, z.
inline double& component(Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
inline double component(const Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
/// Of the largest coordinate; of equals the first.
inline int largest_axis(const Vec3& v) { return v.x >= v.y && v.x >= v.z ? 0 : v.y >= v.z ? 1 : 2; }
/// The axis along which a box is longest.
inline int longest_axis(const Box3& box) { return largest_axis(box.hi - box.lo); }

}  // namespace st
