// No steep lengths in background meshes.
#pragma once

#include <cstdint>

#include "sizing/background.h"

namespace st {

/// Lowers lengths of nodes until no tetrahedron has a gradient above `slope`, then longer ones until the same holds for
/// the lengths along the direction that its nodes share, and along that of each of them. The smallest length of a
/// tetrahedron stays. The number of nodes that were lowered.
std::int64_t limit_growth(double slope, BackgroundMesh& mesh);
/// Likewise the smallest lengths alone.
std::int64_t limit_shortest(double slope, BackgroundMesh& mesh);

}  // namespace st
