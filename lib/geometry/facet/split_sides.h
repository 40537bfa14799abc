// Facets that end on the side of another one (T-junctions).
#pragma once

#include <span>

#include "geometry/facet/facet_mesh.h"

namespace st {

/// Divides facets at nodes that lie on their free sides, within `gap` (model unit), where other free sides run along
/// there: each piece then has its side in common with a facet beyond. Free: a side that one facet has. The surface
/// stays. Returns the number of sides divided.
std::size_t split_sides_at_nodes(FacetInput& input, double gap);

/// Whether a node of one facet lies within `gap` on a side of the other one, between its ends.
bool ends_on_side(std::span<const Vec3> x, const Corners& a, const Corners& b, double gap);

}  // namespace st
