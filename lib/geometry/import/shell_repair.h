// Shells and solids the right way out.
#pragma once

#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/model_tables.h"

namespace st::occt {

/// Turns solids of negative volume, makes loose closed shells solids whose normals point outward, and those inside
/// another one its voids (of voids: solids again). Returns whether anything changed: tables must be made again then.
/// `measures` are those of `model`.
bool repair_shells(ImportedShape& model, const FaceMeasures& measures, std::vector<ImportFinding>& findings);

}  // namespace st::occt
