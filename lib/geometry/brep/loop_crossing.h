// Loops that cross themselves in (u,v).
#pragma once

#include <optional>

#include "geometry/brep/face_domain.h"

namespace st::occt {

/// A place where the loops of a face cross themselves or each other.
struct LoopCrossing {
  Vec3 xyz;
  double size = 0;  ///< extent of the part that is cut off, model unit
};

/// The largest crossing of the sampled loops that is larger than `tolerance`.
std::optional<LoopCrossing> find_loop_crossing(const FaceDomain& domain, double tolerance);

}  // namespace st::occt
