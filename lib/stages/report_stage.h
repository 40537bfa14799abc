// st-report: one HTML file that shows a mesh and what the checks found.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "stages/summary.h"

namespace st {

/// What st-check reports of a mesh, and its verdict.
struct Verdict {
  std::string json = "null";   ///< "null": no mesh, no checks
  std::optional<bool> passes;  ///< empty: no mesh
};

struct ReportStageOptions {
  std::vector<std::string> artifacts;  ///< of one run, in any order: a mesh, patches or a geometry
  std::string geometry;                ///< optional: findings by cause, deviation from the CAD
  std::string sizing;                  ///< optional: lengths compared with the requested ones, slice, causes of sizes
  std::string times;                   ///< optional: folder of <stage>.seconds, as the workflow writes them
  std::string before;                  ///< optional: the mesh before a remeshing, to be compared with
  std::optional<Verdict> checked;      ///< of the mesh, by an earlier run_check with this geometry and sizing
  std::string output = "report.html";  ///< self-contained: page, mesh and figures
};

/// Throws Error(kUsage) unless a browser takes the file for a page: .html or .htm; Error(kOutput) where it cannot be
/// written.
void require_page(const std::string& path);

/// Checks the mesh as st-check does, where that is not done yet, and writes the page. Of patches without a mesh, what
/// there is is merged first. With a geometry alone the page shows the CAD, unchecked. Local; code kOk whatever the
/// verdict. Throws Error.
StageSummary run_report(const ReportStageOptions& options);

}  // namespace st
