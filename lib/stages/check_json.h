// What st-check found, for programs. Internal to the check stage.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "stages/check_report.h"

namespace st {

enum class ReportDetail { kSummary, kFull };

/// One JSON object (docs/checks.md): a line for programs, or in full and indented, with histograms per group and face
/// and all forced places. `processor`: of processor_json(); none: it is not told.
std::string check_report_json(const std::string& path, const SurfaceMesh& mesh, const Findings& f, double seconds,
                              ReportDetail detail, const nlohmann::json& processor = nullptr);

}  // namespace st
