// Trimming curves that leave their edges.
#pragma once

#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"
#include "geometry/model/model_tables.h"

namespace st::occt {

/// Rebuilds by projection every trimming curve that leaves its edge's space curve by more than the edge's tolerance,
/// where the projected one is better; a finding says each change, and each that could not be bettered. Tolerances of
/// edges are raised to the distance that remains, unless it is more than a tolerance can be: that is a finding.
void repair_pcurves(ImportedShape& model, std::vector<ImportFinding>& findings);

/// Faces whose loops cross in (u,v) by more than the tolerance explains, as `tables` of the model say: their trimming
/// curves are projected again even where the tolerance covers them, if the loops then cross no more and the face keeps
/// its area. Narrow faces are such, whose curves are no more exact than they are wide. Returns whether there was one:
/// then the tables are to be made again.
bool repair_crossing_loops(ImportedShape& model, const ModelOfFile& tables, std::vector<ImportFinding>& findings);

}  // namespace st::occt
