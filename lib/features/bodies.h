// Bodies around lifting surfaces: fuselage, nacelles, fairings, antennas.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "features/lifting_surface.h"

namespace st {

/// Faces that hang together, none of them of a lifting surface.
struct Body {
  double diagonal = 0;         ///< of its box, model unit
  double girth = 0;            ///< way around an ellipse as wide as the two smaller extents of its box, model unit
  double chord = 0;            ///< local chord of the lifting surface that is nearest to its middle, model unit
  bool is_wing_piece = false;  ///< no concave edge parts it from a lifting surface: a tip cap, a fillet
};

struct Bodies {
  std::vector<Body> body;
  std::vector<std::int32_t> of_face;  ///< [n_faces] index into `body`; kNone: of a lifting surface, or no wall
};

/// Walls outside of `wings` that share edges, by first face. Bodies end at edges that are concave by 30 degrees or more
/// somewhere: where a fairing stands on a wing, or an antenna on a fuselage. Without lifting surfaces there are none.
/// Local. Cost: five normals on each side of the edges of such faces.
Bodies find_bodies(const Model& model, const FaceRoles& roles, std::span<const LiftingSurface> wings);

}  // namespace st
