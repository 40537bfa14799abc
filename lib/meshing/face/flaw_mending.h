// Obtuse triangles and large steps of size in a stretched mesh, mended where they are.
#pragma once

#include "base/vec.h"
#include "meshing/face/front.h"

namespace st {

/// What is asked for in stretched meshes: no larger angle in space, radians, and no larger step of size. That is the
/// root of the ratio of two neighbours' areas.
inline constexpr double kMostAngle = radians(140);
inline constexpr double kMostGrowth = 2.2;
/// Angles above this one, radians, are mended at any price.
inline constexpr double kFarAngle = radians(150);

/// Where more is found in the face, a side is swapped or an inner node moved, whichever leaves the least: the metric
/// does not see them. Sides and nodes of rows give way where that leaves less, but not those of the lines at which rows
/// begin. The mesh stays valid in the plane, and no triangle turns away from the
/// surface for it. Linear where few are flawed.
void mend_flaws(FaceWork& work);

}  // namespace st
