// Rows on a face that is narrower than its segments are long, between two sides with equally many nodes. Internal to
// lib/meshing.
#pragma once

#include "meshing/face/row_chains.h"

namespace st {

/// Lays a column of nodes between each node of the bottom and the one across, as many as the sizes ask for there, and
/// triangles between neighbouring columns: with about as many rows they have no obtuse angle. False, and nothing: the
/// sides do not fit, or at most columns the face is wider than that, or than a few segments where it is flat.
bool lay_ladder(FaceWork& work, const RowChain& chain);

}  // namespace st
