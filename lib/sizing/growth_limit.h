// No steep lengths in background meshes.
#pragma once

#include <cstdint>

#include "sizing/background.h"

namespace st {

/// Lowers lengths of nodes until no tetrahedron has a gradient above `slope`, then longer ones until the same holds for
/// the lengths along the direction that its nodes share, and along that of each of them. The smallest length of a
/// tetrahedron stays. The number of nodes that were lowered.
std::int64_t limit_growth(double slope, BackgroundMesh& mesh);
/// Likewise of a mesh with metrics: along edges of tetrahedra each metric is intersected with those of its neighbours,
/// grown by the slope in all directions, to 1 % of a length; then the smallest lengths are limited as above.
std::int64_t limit_metrics(double slope, BackgroundMesh& mesh);

}  // namespace st
