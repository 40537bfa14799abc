// Triangles that touch without crossing, moved apart.
#pragma once

#include <span>

#include "base/vec.h"
#include "mesh/surface_mesh.h"

namespace st {

/// Two triangles without a common node that are said to cross.
struct TouchingPair {
  Triangle a, b;
  double reach;  ///< model unit, > 0: one that passes the other's plane by more than that crosses
};

/// Moves nodes from `first_movable` on, where one triangle of a pair lies on one side of the other's plane within its
/// reach: by kTouchingGap of the reach, or by the depth more, off that plane. A node that may not move lets those of
/// the other triangle give way. What crosses stays. Returns whether any node was moved. Local; a few passes over the
/// pairs.
bool move_touching_apart(std::span<const TouchingPair> pairs, NodeId first_movable, std::span<Vec3> points);

inline constexpr double kTouchingGap = 0.1;  ///< of the reach: that far are nodes off the plane afterwards

}  // namespace st
