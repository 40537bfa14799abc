// st-merge: patches to one consistent, oriented, checked mesh in canonical order.
#pragma once

#include <string>
#include <vector>

#include "stages/summary.h"

namespace st {

struct MergeStageOptions {
  std::vector<std::string> patches;  ///< patches artifacts (one, or parts meshed apart)
  std::string output = "mesh.hdf";
  std::vector<std::string> exports;  ///< further files by suffix: .stl .vtu .obj .ply
  bool allow_incomplete = false;     ///< merge although faces are missing
};

/// Everything that could stop the outputs is found before the work, so that none is left without the others. Throws
/// Error.
void require_merge_outputs(const MergeStageOptions& options);

/// Local. Throws Error; Error(kIncomplete) for incomplete patches without allow_incomplete.
StageSummary run_merge(const MergeStageOptions& options);

}  // namespace st
