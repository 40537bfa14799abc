// st-check: is this mesh fit for use?
#pragma once

#include <string>

#include "stages/summary.h"

namespace st {

struct CheckStageOptions {
  std::string mesh;                     ///< mesh artifact
  std::string geometry;                 ///< optional: areas per face, open edges allowed only where the CAD has free edges
  std::string sizing;                   ///< optional: conformity of edge lengths to the sizes
  double area_tolerance = 0.01;         ///< largest relative difference between mesh and CAD area of a face beyond what chords explain
};

/// Local. Summary code kIncomplete when the mesh does not pass. Throws Error.
StageSummary run_check(const CheckStageOptions& options);

}  // namespace st
