// Wing edges where bounds of the reference diagonal are enough to tell them: the diagonal itself may need facets of all
// faces.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "features/face_roles.h"
#include "features/strip.h"
#include "features/wing_edges.h"
#include "geometry/model/model.h"

namespace st {

/// Bounds of a length.
struct LengthBounds {
  double least, most;
};

/// Of what face_roles() finds to be the reference diagonal. `roles`: along the axes of space. Cost: a few points on
/// each edge.
LengthBounds bound_reference_diagonal(const Model& model, const FaceRoles& roles);

/// Those that find_wing_edges() finds with each reference diagonal within the bounds, whatever that of `roles`; nullopt
/// where they differ, or may.
std::optional<std::vector<WingEdge>> find_certain_wing_edges(const Model& model, const FaceRoles& roles,
                                                             std::span<const Strip> strips, LengthBounds diagonal);

}  // namespace st
