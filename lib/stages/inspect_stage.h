// st-info, st-diff, st-export: look at artifacts.
#pragma once

#include <string>

#include "base/number_option.h"
#include "stages/summary.h"

namespace st {

/// What an artifact is, from what it was made, counts. summary.line may have several lines.
StageSummary run_info(const std::string& artifact);
/// The content hash alone in summary.line.
StageSummary run_hash(const std::string& artifact);

struct DiffStageOptions {
  std::string a, b;  ///< two artifacts of the same schema
  double tolerance = 0;
  static constexpr NumberOption kTolerance{
      "--tolerance", "F", "[0, 1]", "allowed relative difference of floating-point numbers; 0: equal to the last bit"};
};
/// Code kOk when equal within the tolerance, kIncomplete when not (says where first, and how much).
StageSummary run_diff(const DiffStageOptions& options);

struct ExportStageOptions {
  std::string artifact, output;
  std::string tolerance = "0.001%";  ///< length: distance of FLITE curves and surfaces from the model
  bool quads = false;                ///< of a mesh: rows of stretched triangles as quadrilaterals
  std::string sizing = {};           ///< of a mesh, for .sol: what its nodes are asked for
};
/// Exports a mesh artifact, a raster/sizing artifact's octree, or a geometry (FLITE .dat), by suffix.
StageSummary run_export(const ExportStageOptions& options);

}  // namespace st
