// Loops of a face that touch along edges.
#pragma once

#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// Where two loops of a face lie on each other between the same two vertices, there and back within the tolerances of
/// their edges, nothing is between them: both edges become one, which the face does not have any more, and the loops
/// become one. Faces whose area would change by more stay as they were. A finding says each, with the length along
/// which they lie so. Cost: pairs of edges with the same ends are compared along their curves.
void join_touching_loops(ImportedShape& model, std::vector<ImportFinding>& findings);

}  // namespace st::occt
