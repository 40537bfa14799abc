// Coordinates by the number of their axis.
#pragma once

#include "base/vec.h"

namespace st {

/// `axis`: 0, 1, 2 for x, y, z.
inline double& component(Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
inline double component(const Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

}  // namespace st
