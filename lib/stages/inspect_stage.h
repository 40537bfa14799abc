// st-info, st-diff, st-export: look at artifacts.
#pragma once

#include <string>

#include "stages/summary.h"

namespace st {

/// What an artifact is, from what it was made, counts. summary.line may have several lines.
StageSummary run_info(const std::string& artifact);
/// The content hash alone in summary.line.
StageSummary run_hash(const std::string& artifact);

struct DiffStageOptions {
  std::string a, b;                     ///< two artifacts of the same schema
  double tolerance = 0;                 ///< relative to the larger value, for floating-point data; 0: bits
};
/// Code kOk when equal within the tolerance, kIncomplete when not (says where first, and how much).
StageSummary run_diff(const DiffStageOptions& options);

/// Exports a mesh artifact (.stl .vtu .obj .ply), or a raster/sizing artifact's octree (.vtu), by suffix.
StageSummary run_export(const std::string& artifact, const std::string& output);

}  // namespace st
