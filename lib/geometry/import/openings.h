// Openings of a model, closed by plane faces.
#pragma once

#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// Closes the openings whose rim lies in a plane, or in two or three planes: the deck and the symmetry plane of half a
/// hull have one rim, and meet in a straight edge that is made. Rims within each other bound one face. A rim gets all
/// of its faces or none. New faces come last in their shell, named "cap_1", "cap_2" ..., the largest first; solids
/// without a free edge come before all shells. `diagonal` of the model, unit of the shape. A finding for each face that
/// was made, and for each rim that is left, with the reason; the outline of a flat face is one. Returns whether faces
/// were made.
bool cap_openings(ImportedShape& model, double diagonal, std::vector<ImportFinding>& findings);

}  // namespace st::occt
