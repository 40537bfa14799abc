// st-report: one HTML file that shows a mesh and what the checks found.
#pragma once

#include <string>
#include <vector>

#include "stages/summary.h"

namespace st {

struct ReportStageOptions {
  std::vector<std::string> artifacts;  ///< of one run, in any order: a mesh, patches or a geometry
  std::string geometry;                ///< optional: findings by cause, deviation from the CAD
  std::string sizing;                  ///< optional: lengths compared with the requested ones, slice, causes of sizes
  std::string times;                   ///< optional: folder of <stage>.seconds, as the workflow writes them
  std::string before;                  ///< optional: the mesh before a remeshing, to be compared with
  std::string output = "report.html";  ///< self-contained: page, mesh and figures
};

/// Checks the mesh as st-check does and writes the page. Of patches without a mesh, what there is is merged first. With
/// a geometry alone the page shows the CAD, unchecked. Local; code kOk whatever the verdict. Throws Error.
StageSummary run_report(const ReportStageOptions& options);

}  // namespace st
