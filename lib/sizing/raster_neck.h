// Sizes of narrow parts of faces: their width asks for sizes that no curvature shows.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "sizing/octree.h"
#include "sizing/size_limits.h"
#include "sizing/space_sides.h"

namespace st {

/// Where two sides of a face's loops face each other across a narrow part of it, appends boxes that ask for twice its
/// width: triangles there are as flat as the width over the length. Narrower than a sixth of the smallest length asks
/// for nothing; where the part tapers, the smallest length is the bound. `counts(a, b)`: whether the width between two
/// coedges may ask for lengths. Local.
void raster_necks(std::span<const SpaceSide> sides, const SamplingLimits& limits, std::int32_t cause,
                  const std::function<bool(CoedgeId a, CoedgeId b)>& counts, std::vector<RasterBox>& boxes);

}  // namespace st
