// Which triangles of a surface with lengths at its nodes tell the lengths around it.
#pragma once

#include "sizing/background.h"

namespace st {

/// The triangles of `mesh` without those at which another one asks for as little, by its growth by `slope`: where
/// lengths grow as fast as that, few tell all. The smallest length over those kept is never below that over all, and
/// at most 0.5 % above it. Growth is convex, so that the three corners of a triangle are enough to compare. All of them
/// where lengths are longer along a direction. Ascending. O(n log n) in practice.
std::vector<std::array<std::int32_t, 3>> telling_triangles(const BackgroundMesh& mesh, double slope);

}  // namespace st
