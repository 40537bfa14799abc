// Edges inside faces, on which other faces end.
#pragma once

#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// Makes slits of the edges that OpenCASCADE marks INTERNAL to a face and that bound other faces (baffles on a wall,
/// after a boolean operation): a loop there and back, so that meshes of both meet in the same nodes. Such edges that
/// bound nothing are left out as ever.
void open_slits(ImportedShape& model, std::vector<ImportFinding>& findings);

}  // namespace st::occt
