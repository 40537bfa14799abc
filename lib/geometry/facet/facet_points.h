// Nodes of facets at one place.
#pragma once

#include "geometry/facet/facet_mesh.h"

namespace st {

/// Nodes with equal coordinates become the lowest of them in all corners; they stay in the list of nodes. -0 equals 0.
/// Files with numbered nodes (OBJ, PLY, MSH ...) have such where faces of their program end. Linear.
void join_equal_points(FacetInput& facets);

}  // namespace st
