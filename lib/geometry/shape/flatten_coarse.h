// Parameters for patches of many triangles, by way of a coarse one.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/shape/chart_topology.h"

namespace st {

/// As flatten(), for a patch too large to be solved at once: a patch of some thousand triangles is flattened, and the
/// other nodes come back one by one, each where the symmetric Dirichlet energy of the triangles around it is low.
/// Where a node comes back there is always a place without flips (Sander et al. 2002). nullopt as flatten() has it.
/// The same input gives the same bits. Cost: microseconds per triangle.
std::optional<std::vector<Vec2>> flatten_coarse(std::span<const Vec3> x, std::span<const Corners> corners,
                                                const PatchTopology& topology);

}  // namespace st
