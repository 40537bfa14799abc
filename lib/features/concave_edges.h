// Edges at which one body stands on another: wing on fuselage, fairing on wing, antenna on fuselage.
#pragma once

#include <cstdint>
#include <vector>

#include "features/face_roles.h"
#include "geometry/model/model.h"

namespace st {

/// [n_edges] 1: two walls meet, concave by 30 degrees or more at one of five places. Material is where normals point
/// away from, see is_material_ahead(). Local. Cost: five normals on each side of every edge between walls.
std::vector<std::uint8_t> find_concave_edges(const Model& model, const FaceRoles& roles);

}  // namespace st
