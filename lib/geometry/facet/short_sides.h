// Sides of facets whose ends single precision cannot tell apart.
#pragma once

#include "geometry/facet/facet_mesh.h"

namespace st {

/// Makes one node of both ends of such a side, the lower one, where the facets stay a surface: no node is a neighbour
/// of both but those opposite the side. Facets beside it go. `gap`: model unit, no longer sides go. Returns the number
/// of sides that went.
std::size_t join_ends_of_short_sides(FacetInput& input, double gap);

}  // namespace st
