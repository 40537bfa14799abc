// Models that are the air in a passage, without a role that says so: blades and vanes are holes in them.
#pragma once

#include <span>
#include <vector>

#include "base/executor.h"
#include "features/face_roles.h"
#include "features/strip.h"
#include "features/wing_edges.h"
#include "geometry/model/model.h"

namespace st {

/// Whether holes lead through a closed model, as where a vane reaches from wall to wall; by Euler's formula. Cheap.
bool has_through_holes(const ModelTables& tables);

/// Whether a closed solid has holes with the profile of a wing: then it is taken for the air around them. Their noses
/// are round: holes between plane faces are a machine part's. False where roles say which side is air. Collective; the
/// same on every rank. Cost: one more search for edges and lifting surfaces.
bool has_vanes(const Model& model, FaceRoles roles, std::span<const Strip> strips,
               const Executor& executor = SerialExecutor());

}  // namespace st
