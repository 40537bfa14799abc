// Trimming curves that leave their edges.
#pragma once

#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// Rebuilds by projection every trimming curve that leaves its edge's space curve by more than the edge's tolerance,
/// where the projected one is better; a finding says each change, and each that could not be bettered. Tolerances of
/// edges are raised to the distance that remains, unless it is more than a tolerance can be: that is a finding.
void repair_pcurves(ImportedShape& model, std::vector<ImportFinding>& findings);

}  // namespace st::occt
