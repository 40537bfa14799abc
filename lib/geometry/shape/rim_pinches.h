// Whether the rim of a flattened patch comes near itself where it is far apart in space.
#pragma once

#include <span>

#include "base/vec.h"
#include "geometry/shape/chart_topology.h"

namespace st {

/// Whether points of the rim are nearer to each other in the plane than 1/kMostStretch of their distance in space:
/// across such a gap places would jump. Two thousand points, evenly spaced along all loops, are compared. `x`, `p`:
/// [nodes] in space and in the plane. Cost: near linear in the points where the rim does not come near itself.
bool rim_pinches(std::span<const Vec3> x, const PatchTopology& topology, std::span<const Vec2> p);

}  // namespace st
