// st-report: one HTML file that shows a mesh and what the checks found.
#pragma once

#include <string>

#include "stages/summary.h"

namespace st {

struct ReportStageOptions {
  std::string mesh;                    ///< mesh artifact
  std::string geometry;                ///< optional: findings by cause, deviation from the CAD
  std::string sizing;                  ///< optional: lengths compared with the requested ones
  std::string output = "report.html";  ///< self-contained: page, mesh and figures
};

/// Checks the mesh as st-check does and writes the page. Local; code kOk whatever the verdict. Throws Error.
StageSummary run_report(const ReportStageOptions& options);

}  // namespace st
