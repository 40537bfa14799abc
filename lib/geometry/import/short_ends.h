// Edges that stop short of their vertex, as those of fillets do where they end.
#pragma once

#include <vector>

#include "geometry/model/finding.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// Edges whose curve, and trimming curves on all faces, go on to their vertex beyond their end are made to end there.
/// Each is said in `findings`. Cost: two points of each edge.
void extend_short_ends(ImportedShape& model, std::vector<ImportFinding>& findings);

}  // namespace st::occt
