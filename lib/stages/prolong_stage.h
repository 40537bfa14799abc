// st-prolong: slope-limited mesh size specification from a raster.
#pragma once

#include <string>

#include "stages/summary.h"

namespace st {

struct ProlongStageOptions {
  std::string raster;                   ///< raster artifact
  std::string output = "sizing.hdf";
  double slope = 0.2;                   ///< largest change of length per distance, (0, 2]
  double scale = 1.0;                   ///< multiplies every length, > 0
};

/// Local. Throws Error.
StageSummary run_prolong(const ProlongStageOptions& options);

}  // namespace st
