// Loops in another period of their surface.
#pragma once

#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// On surfaces that close in u, v or both, be it within the tolerance of the face's edges, moves by whole periods:
/// holes that lie outside the face's outer loop, and inside it in another period; and whole faces that lie beyond the
/// bounds of a surface that is closed, but not periodic, where it cannot be evaluated. Before that bands between loops
/// that go around, without a seam, get one. Each is said in `findings`, and
/// so is a hole that is inside in no period: in space it is outside the face. Nothing else is touched. Cost: samples of
/// the loops of faces that have holes, one point of each edge else.
void move_loops(ImportedShape& model, std::vector<ImportFinding>& findings);

}  // namespace st::occt
