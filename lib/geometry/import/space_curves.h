// Space curves that are missing, or elsewhere than their faces.
#pragma once

#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// Edges of faces that have no space curve, and are no poles, get one from a trimming curve: the one that ends at the
/// edge's vertices and lies best on the other faces of the edge. Where the others leave it, parameters are marked as
/// unequal, for repair_loops(). What is one point is marked as a pole; a pole between two vertices is none. Each is
/// said in `findings`, and so are edges for which no curve can be made. Cost: a look at each edge.
void make_space_curves(ImportedShape& model, std::vector<ImportFinding>& findings);

/// Where the trimming curves of an edge lie at one place in space, on all faces that have it, and its space curve lies
/// elsewhere, the space curve is wrong: it is made again through points of the surfaces. Ends that miss the edge's
/// vertices, and edges of one face, stay as they are. Cost: two points of each use of an edge.
void rebuild_space_curves(ImportedShape& model, std::vector<ImportFinding>& findings);

}  // namespace st::occt
