// Edges that may run along the span of a thin body: candidates for wings whose trailing edge is no edge.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/executor.h"
#include "features/face_roles.h"
#include "features/lifting_surface.h"
#include "geometry/model/model.h"

namespace st {

/// Smooth edges between free-form walls, seams too, that belong to none of `wings`, are closed or about straight, at
/// least 1/50 of the reference diagonal and half of the chord long, and where the faces around are thin: samples near
/// the plane square to the edge half way lie in a flat rectangle. Ascending. Collective: some edges are a task; `wings`
/// and what is returned are of rank 0. Cost: some hundred points on each free-form face with such an edge, and those
/// around it.
std::vector<EdgeWithChord> find_span_edges(const Model& model, const FaceRoles& roles,
                                           std::span<const LiftingSurface> wings,
                                           const Executor& executor = SerialExecutor());

}  // namespace st
