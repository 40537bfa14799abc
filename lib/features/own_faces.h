// What belongs to a lifting surface of all that its profiles cross.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "features/lifting_surface.h"
#include "geometry/model/model.h"

namespace st {

/// [n_faces] of those allowed ([n_faces]) the ones that no concave edge parts from the trailing edges. `is_concave`:
/// [n_edges]. Local.
std::vector<std::uint8_t> find_own_faces(const ModelTables& t, std::span<const std::uint8_t> is_concave,
                                         std::span<const std::uint8_t> is_allowed, const LiftingSurface& surface);

/// [n_faces] likewise through all walls, without those that a concave edge parts from a face of the surface: other
/// bodies, which may go on smoothly around a corner. `is_wall`: [n_faces]. Local.
std::vector<std::uint8_t> find_body_faces(const ModelTables& t, std::span<const std::uint8_t> is_concave,
                                          std::span<const std::uint8_t> is_wall, const LiftingSurface& surface);

/// [n_faces] likewise through the faces that profiles cross. Local.
std::vector<std::uint8_t> find_crossed_own_faces(const ModelTables& t, std::span<const std::uint8_t> is_concave,
                                                 const LiftingSurface& surface);

/// Keeps, of the faces that profiles cross, those that no concave edge parts from the trailing edge, and `covers`, and
/// of the stations those whose nose lies there: profiles cross fairings, too. `is_concave`: [n_edges]. Local.
void keep_own(const ModelTables& t, std::span<const std::uint8_t> is_concave, std::span<const FaceId> covers,
              LiftingSurface& surface);

}  // namespace st
