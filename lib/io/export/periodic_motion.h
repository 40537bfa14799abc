// The motion between periodic faces as CGNS and SU2 write it.
#pragma once

#include "base/similarity.h"

namespace st {

/// x -> Rz Ry Rx (x - center) + center + translation. The translation is along the axis, so that the way back has the
/// same center, the opposite translation and, about one axis, the opposite turns.
struct PeriodicMotion {
  Vec3 center;               ///< the point of the axis that is nearest to the origin, model unit
  Vec3 turns;                ///< radians about x, then y, then z: axes of space, right-handed
  Vec3 translation;          ///< model unit
  bool has_own_axis = true;  ///< turns about x, y or z alone, or not at all
};

/// Precondition: `motion` neither scales nor mirrors. Turns below 1e-12 are none.
PeriodicMotion periodic_motion(const Similarity& motion);

}  // namespace st
