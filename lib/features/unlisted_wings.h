// Wings without an edge that could be their trailing edge: sheets without thickness, and blades that are round all
// over.
#pragma once

#include <vector>

#include "features/face_roles.h"
#include "features/lifting_surface.h"
#include "geometry/model/model.h"

namespace st {

/// Free edges of walls that bound sheets about as flat as a sail, ascending; not those in a plane through which the
/// surface goes, as at the open ends of a body. Local. Cost: a few points on each free edge.
std::vector<EdgeId> find_sheet_edges(const Model& model, const FaceRoles& roles);

/// Seams of spline walls that belong to none of `wings`, or edges between two that share a second one, whose cut half
/// way is the profile of a wing, both ends round and inside the face, ascending. Local. Cost: exact facets of such
/// walls.
std::vector<EdgeId> find_seams_of_blades(const Model& model, const FaceRoles& roles,
                                         std::span<const LiftingSurface> wings);

}  // namespace st
