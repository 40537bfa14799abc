// Loops in another period of their surface.
#pragma once

#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// On surfaces that close in u, v or both, be it within the tolerance of the face's edges, moves by whole periods:
/// holes that lie outside the face's outer loop, and inside it in another period; and whole faces that lie beyond the
/// bounds of a surface that is closed, but not periodic, where it cannot be evaluated. Before that bands between loops
/// that go around, without a seam, get one. Where all of several loops on an open surface run the same way, those that
/// run the wrong way are turned. A hole that is inside in no period, on planes and other open surfaces, too, bounds
/// nothing: it is left out, and the face ends at its outer loop. Each is said in `findings`; other faces that end at
/// such a hole are named, the model is open there. Cost: samples of the loops of faces that have holes, one point of
/// each edge else.
void move_loops(ImportedShape& model, std::vector<ImportFinding>& findings);

}  // namespace st::occt
