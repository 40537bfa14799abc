// Faces with a kink inside become several.
#pragma once

#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// Divides faces at their kinks (find_kinks()), so that these become edges; edges that a kink meets are divided for all
/// faces that have them: what was closed still is. Parts have the face's name, layer, colour and part, edges their
/// names. A face whose parts have another area, or edges that leave a neighbour, stays as it is. Each face is said in
/// `findings`. The shape has no locations where one was divided. Cost where there is no kink: a look at
/// each face.
void divide_kinked_faces(ImportedShape& model, std::vector<ImportFinding>& findings);

}  // namespace st::occt
