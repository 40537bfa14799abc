// What belongs to a lifting surface of all that its profiles cross.
#pragma once

#include <cstdint>
#include <span>

#include "features/lifting_surface.h"
#include "geometry/model/model.h"

namespace st {

/// Keeps, of the faces that profiles cross, those that no concave edge parts from the trailing edge, and of the
/// stations those whose nose lies there: profiles cross fairings, too. `is_concave`: [n_edges]. Local.
void keep_own(const ModelTables& t, std::span<const std::uint8_t> is_concave, LiftingSurface& surface);

}  // namespace st
