// Is the model the fluid around a body? From topology and extents, where no name says so.
#pragma once

#include <span>
#include <vector>

#include "geometry/model/model.h"

namespace st {

/// Faces of the outer boundary, ascending; empty where the model is no flow domain. One set of connected faces has to
/// reach all sides of the model's box, and all others, the body, are small and keep away from these sides. The body is
/// inside, or stands on one or two planes that lie in sides of the box: planes count apart, so that body and outer
/// faces part there. What stands on a plane is a pocket of a machine part as well: it must have a free-form face, or
/// the outer faces must be a sphere's. `face_box` [n_faces]: along any axes at right angles. Cost: linear in the
/// coedges, at most 19 times.
std::vector<FaceId> find_flow_domain(const ModelTables& tables, std::span<const Box3> face_box);

}  // namespace st
