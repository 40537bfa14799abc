// A wing whose lifting surface is known, for tests of its noses.
#pragma once

#include "features/lifting_surface.h"
#include "features/strip.h"
#include "features/wing_edges.h"
#include "support/shapes.h"

namespace st::test {

/// A sharp NACA 0012 of chord 10 along z, from 0 to 30; its nose is round, at x = 0.
struct SharpWing {
  Model model = make_model("sharp_wing");
  FaceRoles roles = face_roles(model.tables());
  LiftingSurface wing = find_lifting_surfaces(model, roles, find_wing_edges(model, roles, find_strips(model))).at(0);
};

}  // namespace st::test
