// Space curves that are elsewhere than their faces.
#pragma once

#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// Where the trimming curves of an edge lie at one place in space, on all faces that have it, and its space curve lies
/// elsewhere, the space curve is wrong: it is made again through points of the surfaces. Ends that miss the edge's
/// vertices, and edges of one face, stay as they are. Cost: two points of each use of an edge.
void rebuild_space_curves(ImportedShape& model, std::vector<ImportFinding>& findings);

}  // namespace st::occt
