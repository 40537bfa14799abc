// Sewing that may not change the faces.
#pragma once

#include <vector>

#include "geometry/import/import.h"
#include "geometry/import/sewing.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// sew_if_open(), and the area of each face before and after it. What moves edges by a tolerance changes an area by
/// what these edges sweep; faces that change by more (a twisted band whose ends are joined, a face folded together) are
/// taken back, each said in `findings` with both areas, and the others are sewn without them. Faces that are taken back
/// come last in the model. Cost: a few points of each trimming curve; areas only where these enclose something else.
void sew_and_keep_areas(ImportedShape& model, const SewingLimits& limits, std::vector<ImportFinding>& findings);

}  // namespace st::occt
