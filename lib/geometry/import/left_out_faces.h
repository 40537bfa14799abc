// Faces that cannot be meshed at all.
#pragma once

#include <string>
#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"
#include "geometry/model/model_tables.h"

namespace st::occt {

/// Takes out the faces whose area or box is no number, and those with an edge that has no curve in space or no trimming
/// curve after all repairs. Each is said in `findings`, with its name and why. `tables` are those of `model`. Returns
/// whether there was one: then they are to be made again. Throws Error(kGeometry) naming the first where no other face
/// is left.
bool leave_out_faces(ImportedShape& model, const ModelTables& tables, std::vector<ImportFinding>& findings,
                     const std::string& path);

}  // namespace st::occt
