// st-check's thresholds: bounds that the user gives. Internal to the check stage.
#pragma once

#include "mesh/quality.h"
#include "stages/check_report.h"

namespace st {

/// Adds a check to `f`, whose measures are there, for each bound that is asked for. `tables`: null without a geometry.
void check_thresholds(const SurfaceMesh& mesh, const TriangleCorners& corners, const CheckThresholds& asked,
                      const ModelTables* tables, Findings& f);

}  // namespace st
