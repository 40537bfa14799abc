// The numbers that drive the sampling of curves and surfaces.
#pragma once

#include "base/vec.h"

namespace st {

/// How a curve or a face is sampled. Invariants: 0 < min_length <= max_length, 0 < alpha <= pi/2, 1 <= cell_per_length <= 8.
struct SamplingLimits {
  double min_length = 0;       ///< smallest sample length, model unit
  double max_length = 0;       ///< largest sample length, model unit
  double alpha = radians(10);  ///< largest turning of tangent or normal along one length, radians
  double cell_per_length = 2;  ///< edge of a raster box over its sample length
};

}  // namespace st
