// Rooms with common walls, and sheets in them.
#pragma once

#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// Divides each shell with an edge of three faces or more into solids, one for each room that its faces close: a wall
/// between two rooms is a face of both. What closes none is a sheet, in a shell of its own. Walls and sheets are
/// findings. Faces of a room and rooms keep the order of the model's faces. A shell that closes no room stays.
void divide_into_rooms(ImportedShape& model, std::vector<ImportFinding>& findings);

}  // namespace st::occt
