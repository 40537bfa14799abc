// Loops whose edges lie in different periods of their surface.
#pragma once

#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// Moves trimming curves by whole periods so that each begins where the one before it ends, where the loop is closed
/// then. OpenCASCADE puts the new edge of a face that it divides into the first turn, though a thread goes around its
/// cylinder several times: area and mesh of such a face are wrong. Loops with a seam stay. Each face is said in
/// `findings`. Cost: the ends of the edges of all periodic faces.
void join_loops(ImportedShape& model, std::vector<ImportFinding>& findings);

}  // namespace st::occt
