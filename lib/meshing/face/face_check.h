// Tests of a face's mesh: every edge used as often as it must be, no folds. Internal to lib/meshing.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "meshing/face/face_mesher.h"
#include "meshing/face/triangulation.h"

namespace st {

/// Are two corners of the triangle nodes of one pole? In space it has no area.
bool has_pole_side(const Triangulation& mesh, const PlaneTriangle& t);

/// Every edge used twice (boundary segments as often as the loops use them, or not at all where that is twice), no
/// triangle with a repeated node, no repeated triangle. Else sets the cause and places to refine. `elsewhere`: uses of
/// edges between boundary nodes by further triangles, as ids, the smaller first.
void check_edges(const FaceBoundary& boundary, FaceMesh& mesh,
                 std::span<const std::array<std::int32_t, 2>> elsewhere = {});

/// Counts triangles turned against the surface, and neighbours folded onto each other, and adds their places to refine.
void check_folds(const Triangulation& triangulation, FaceMesh& mesh);

}  // namespace st
