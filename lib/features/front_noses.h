// Noses behind which the trailing edge is another part's, or none: before flaps, slots and notches.
#pragma once

#include <span>

#include "features/lifting_surface.h"
#include "geometry/shape/loop_polygons.h"

namespace st {

/// Sets `front` of each surface: from where its noses end or jump, at a slot behind them, the nose is followed on its
/// face. It is as long as some trailing edge lies behind it, or a gap between two of this surface, or to where noses go
/// on. Behind a gap it is the straight line across that counts. It ends with its faces. Local. Cost: nearly nothing for
/// surfaces whose noses run from end to end; else some dozen evaluations for each twentieth of the chord.
void add_front_noses(const Model& model, std::span<LiftingSurface> surfaces);

/// Whether some noses before the second edge of a base are others than those before the first: corners of the wall of a
/// slot. Local; stations of one times those of the other.
bool has_other_noses(const LiftingSurface& wing, const ChordEdge& second);

/// The loops of a face, its edges as chords. Local.
LoopPolygons loops_of(const Model& model, FaceId face);

}  // namespace st
