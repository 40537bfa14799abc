// The advancing front inside a constrained triangulation of the face (Rebay 1993; Marcum and Weatherill 1995): internal
// to lib/meshing.
#pragma once

#include "meshing/face/face_work.h"

namespace st {

/// Advances the front from the boundary until every triangle is finished or retired, then splits what is still too
/// large.
void advance_front(FaceWork& work);

/// Swaps, smooths, collapses and splits for `rounds` rounds; keeps the triangulation valid in the plane and does not
/// fold it in space.
void enhance(FaceWork& work, int rounds);

}  // namespace st
