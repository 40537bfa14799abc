// Sizes of narrow faces: their width asks for sizes that no curvature shows.
#pragma once

#include <cstdint>
#include <vector>

#include "features/strip.h"
#include "sizing/octree.h"
#include "sizing/size_limits.h"

namespace st {

/// Appends boxes along the strip that ask for 1.25 times its width (triangles as good as their neighbours), at most the
/// largest length; nothing where it is narrower than a sixth of the smallest length, or, where its edges
/// cross, than twice Strip::exact. Above that the smallest length is
/// no bound: the triangles across the strip have sides as short as it is wide anyway, and longer ones along it make
/// them flat.
void raster_strip(const Strip& strip, const SamplingLimits& limits, std::int32_t cause, std::vector<RasterBox>& boxes);

}  // namespace st
