// Groups that the shape of a model suggests: wings, tails, fuselage, nacelles, pylons, far field.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "features/bodies.h"
#include "features/face_roles.h"
#include "features/lifting_surface.h"
#include "geometry/model/model.h"

namespace st {

struct SuggestedGroup {
  std::string name;           ///< "wing", "tailplane", "fin", "fuselage" ...
  std::string role;           ///< "wall", "symmetry", "farfield" or "interface"
  std::string why;            ///< in plain words
  std::vector<FaceId> faces;  ///< [n >= 1] ascending
};

/// What is known of the faces: roles, `wings` by their place, span and direction, rings of trailing edges as nacelles,
/// and `bodies` by what they touch. Faces of which nothing is known are in no group. By first face. Local; linear in
/// faces and stations.
std::vector<SuggestedGroup> suggest_groups(const ModelTables& tables, const FaceRoles& roles,
                                           std::span<const LiftingSurface> wings, const Bodies& bodies);

}  // namespace st
