// Openings of a model, closed by plane faces.
#pragma once

#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// Closes the openings whose rim lies in a plane, or in two or three planes: the deck and the symmetry plane of half a
/// hull have one rim, and meet in a straight edge that is made. Rims within each other bound one face. New faces come
/// last in their shell, the largest first, and are named "cap_1", "cap_2" ...; solids without a free edge stay as they
/// are, and so does the outline of a flat sheet. `diagonal` of the model, unit of the shape. A finding for each face
/// that was made, and for each rim that lies in no planes. Returns whether faces were made.
bool cap_openings(ImportedShape& model, double diagonal, std::vector<ImportFinding>& findings);

}  // namespace st::occt
