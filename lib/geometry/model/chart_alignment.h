// Charts of composites, turned in their plane.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/model/model.h"
#include "geometry/model/uv_facets.h"

namespace st {

/// Turns the places `uv` of nodes so that u goes where the faces bend least, on the average. Patches of (u,v) then do,
/// too: else they are as long as they are wide, across noses as well. `triangles` of the facets have these `corners`
/// among the nodes `x`. Local. Cost: an evaluation for each triangle.
void align_chart(const Model& cad, const UvFacets& facets, std::span<const std::int32_t> triangles,
                 std::span<const Vec3> x, std::span<const Corners> corners, std::vector<Vec2>& uv);

}  // namespace st
