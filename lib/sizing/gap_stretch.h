// Longer lengths along a gap: what counts is how wide it is, not how long.
#pragma once

#include "sizing/gap_patch.h"
#include "sizing/octree.h"

namespace st {

/// What a place of a patch sees.
struct GapPlace {
  Vec3 x;                 ///< on the patch, model unit
  Vec3 normal;            ///< of the patch there, unit
  const GapPatch* other;  ///< what faces it
  Vec3 met;               ///< the place on the other patch
  double length;          ///< that is asked for across the gap, model unit
};

/// Along the direction of the patch's own stretch, that of the other side's, or the one in which the gap stays as wide,
/// if that allows much more. It turns by no more than alpha along one length on both sides, the chord stays as near as
/// that of one length across, and the width of the gap changes little. Nothing where the patch may not be stretched.
SampleStretch gap_stretch(const GapPatch& patch, const GapPlace& place);

}  // namespace st
