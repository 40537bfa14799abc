// Loops, parameters and trimming curves made usable.
#pragma once

#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// Faces without loops, and rings whose loops enclose nothing, get their natural bounds; wires that cannot be walked,
/// edges without a trimming curve and unequal parameters are repaired, each said in `findings`. A model that needs
/// nothing is not touched, but for trimming curves on planes, which are stored.
void repair_loops(ImportedShape& model, std::vector<ImportFinding>& findings);

}  // namespace st::occt
