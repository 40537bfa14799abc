// Loops of curved faces whose trimming curves are elsewhere.
#pragma once

#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// Rebuilds the loops of a curved face from the space curves of its edges where a reader has lost them in (u,v): a
/// trimming curve far from its edge, a pole that is no point, a loop that cannot be walked (fillets of radius larger
/// than the bend they go around, tubes bent by half a period). Every edge is sampled and projected, the pieces are
/// joined end to end across periods; what does not close, or does not lie on the surface, stays as it was. Tolerances
/// that the reader had raised are set back to the distances that remain.
void rebuild_lost_loops(ImportedShape& model, std::vector<ImportFinding>& findings);

}  // namespace st::occt
