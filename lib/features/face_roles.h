// What a face is to the flow: body, outer boundary, symmetry plane.
#pragma once

#include <vector>

#include "features/own_axes.h"
#include "geometry/model/model.h"

namespace st {

enum class FaceRole : unsigned char { kWall, kFarfield, kSymmetry };

struct FaceRoles {
  std::vector<FaceRole> role;   ///< [n_faces]
  std::vector<FaceId> guessed;  ///< faces taken as outer boundary by their extent, because no group is named far field
                                ///< or symmetry
  double reference_diagonal = 0;  ///< of the box of all walls, model unit: what default lengths and per cents refer to
  OwnAxes own;                    ///< along which extents are measured
};

/// Whether roles may be guessed where no name says anything.
enum class RoleGuess : unsigned char { kAllowed, kForbidden };

/// Roles from the names of groups; all faces are walls when none is. Where no name says anything, a body in a domain is
/// recognised by its extent: when every face is either large (its box's diagonal at least 1/4 of the model's) or
/// belongs to a rest that fits into a box of 1/20 of the model's diagonal and lies in the box of the large ones, the
/// large ones are the outer boundary. Those that share an edge with the body count as symmetry planes - they have to be
/// planes, no two of them opposite - the others as far field. Larger bodies: find_flow_domain().
/// Boxes lie along the model's own axes, but along those of space where the walls' box there has nearly the same
/// diagonal: a model that was drawn along the axes of space is measured along them. Collective.
FaceRoles face_roles(const Model& model, RoleGuess guess = RoleGuess::kAllowed,
                     const Executor& executor = SerialExecutor());
/// Likewise, along the axes of space.
FaceRoles face_roles(const ModelTables& tables, RoleGuess guess = RoleGuess::kAllowed);

/// Normals of faces point into the material: the model is the domain around walls, or its solids are turned inward.
bool is_material_ahead(const ModelTables& tables, const FaceRoles& roles);

}  // namespace st
