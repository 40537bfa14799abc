// Lifting surfaces whose trailing edge is round and runs inside smooth faces: closed blades, hydrofoils, propellers.
#pragma once

#include <span>
#include <vector>

#include "base/executor.h"
#include "features/face_roles.h"
#include "features/lifting_surface.h"
#include "features/wing_edges.h"
#include "geometry/model/model.h"

namespace st {

/// Appends lifting surfaces to `wings` where smooth edges of free-form walls, seams too, run along a body whose cuts
/// are a wing's profile (features/profile.h) at half of the way or more, clearly thinner at one end than at the other.
/// Not on faces of `wings`, nor where the tail runs along an edge in `is_excluded` ([n_edges]) or along the tail of
/// cuts at such an edge. `edges`: of find_wing_edges(); those along the noses become leading edges. By first edge.
/// Collective; `wings`, `edges` and `is_excluded` are of rank 0. Cost: find_span_edges(); then, on rank 0, coarse
/// facets at each such edge, exact ones of thin bodies.
void add_round_tails(const Model& model, const FaceRoles& roles, std::span<const WingEdge> edges,
                     std::span<const std::uint8_t> is_excluded, std::vector<LiftingSurface>& wings,
                     const Executor& executor = SerialExecutor());

}  // namespace st
