// st-info, st-diff: look at artifacts.
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

}  // namespace st
