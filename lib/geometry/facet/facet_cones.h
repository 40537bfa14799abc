// Folded patches of facets parted along their sides.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/facet/facet_mesh.h"

namespace st {

/// Whether neighbours turn by more than 120 degrees: no cut by a plane takes that away.
bool is_folded(const FacetPatch& patch);

/// Parts a patch that no plane cut makes flat: each group grew over sides from its largest triangle to those whose
/// normals are within 60 degrees of that one's. A few triangles left between the cones go to one of them. Where that
/// leaves one group, the triangles on each side of a plane through the middle are one. Returns the group of each
/// triangle of the patch; all 0 for one triangle.
std::vector<std::int32_t> part_by_normals(const FacetPatch& patch);

}  // namespace st
