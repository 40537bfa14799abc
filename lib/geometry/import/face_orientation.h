// Loose faces and open shells the right way out.
#pragma once

#include <vector>

#include "geometry/model/finding.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// Makes shells of faces that share edges but are in none, and turns faces that belong to no solid: neighbours across
/// an edge of two agree, as the larger area among them has it, and an open surface that encloses most of a body, such
/// as a wing without its root, points out of it. One-sided surfaces and sheets stay as they are. What depends on the
/// side, such as concave edges and gaps, is asked later. In a solid whose faces disagree, and that has no wall in
/// common with another, they are turned likewise; repair_shells() turns it outward.
void orient_faces(ImportedShape& model, std::vector<ImportFinding>& findings);

}  // namespace st::occt
