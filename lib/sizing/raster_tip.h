// Where a face runs to a point, how it bends across asks for lengths for nothing.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sizing/octree.h"
#include "sizing/size_limits.h"
#include "sizing/space_sides.h"

namespace st {

/// Takes away boxes from `first` on, of lengths below the largest, where the face is much narrower than the length and
/// runs to a point between two edges. Triangles there are flat at any length, and the more the smaller it is; across
/// so little the face turns by less than a length may. `sides`: all of the face. Local.
void drop_tips(std::span<const SpaceSide> sides, const SamplingLimits& limits, std::size_t first,
               std::vector<RasterBox>& boxes);

}  // namespace st
