// What a face is to the flow: body, outer boundary, symmetry plane.
#pragma once

#include <vector>

#include "features/own_axes.h"
#include "geometry/model/model.h"

namespace st {

enum class FaceRole : unsigned char {
  kWall,
  kFarfield,
  kSymmetry,
  kInterface  ///< in a flow domain: air on both sides
};

struct FaceRoles {
  std::vector<FaceRole> role;     ///< [n_faces]
  double reference_diagonal = 0;  ///< of the box of all walls, model unit: what default lengths and per cents refer to
  OwnAxes own;                    ///< along which extents are measured
  bool is_passage = false;        ///< the model is taken for the air between its walls, without a far field
};

/// Roles from those of groups, which the import recognised or names gave; all faces are walls when none is, and
/// interfaces are walls without a far field. Periodic faces with an inlet or an outlet, and no far field, make the
/// model a passage: a sector of a machine part has no inlets, a body no periodic faces. Boxes lie along the model's own
/// axes, but along those of space where the walls' box there has nearly the same diagonal: a model that was drawn along
/// the axes of space is measured along them. Collective.
FaceRoles face_roles(const Model& model, const Executor& executor = SerialExecutor());
/// Likewise, along the axes of space.
FaceRoles face_roles(const ModelTables& tables);

/// Normals of faces point into the material: the model is the domain around walls or a passage, or its solids are
/// turned inward.
bool is_material_ahead(const ModelTables& tables, const FaceRoles& roles);

}  // namespace st
