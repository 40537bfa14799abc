// Faces and solids that are there twice.
#pragma once

#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// Removes faces outside solids at the place of an earlier one, or of a solid's: same vertices, box, area and surface
/// within the tolerances. Faces of solids stay: parts that touch have coincident faces by right.
void remove_duplicates(ImportedShape& model, std::vector<ImportFinding>& findings);

/// Removes solids all faces of which lie so on those of an earlier solid: two meshes at one place are no mesh. Only
/// solids of one box are compared face by face.
void remove_duplicate_solids(ImportedShape& model, std::vector<ImportFinding>& findings);

}  // namespace st::occt
