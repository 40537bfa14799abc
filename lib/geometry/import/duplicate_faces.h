// Faces and solids that are there twice.
#pragma once

#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// Removes faces outside solids at the place of an earlier one, or of a solid's: same vertices, box, area and surface
/// within the tolerances. Faces of solids stay: parts that touch have coincident faces by right.
void remove_duplicates(ImportedShape& model, std::vector<ImportFinding>& findings);

/// Makes faces one that have the same edges, but for poles, and lie on each other within the tolerances, whatever they
/// belong to: what shares its edges in the file is one wall, a face of all its solids. The first of them stays. Cost: a
/// look at the edges where none has more than two faces.
void share_common_faces(ImportedShape& model, std::vector<ImportFinding>& findings);

/// Removes solids all faces of which lie so on those of an earlier solid: two meshes at one place are no mesh. Only
/// solids of one box are compared face by face.
void remove_duplicate_solids(ImportedShape& model, std::vector<ImportFinding>& findings);

}  // namespace st::occt
