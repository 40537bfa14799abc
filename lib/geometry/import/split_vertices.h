// Arcs between fillets that are marked as poles, with one vertex half way between their ends.
#pragma once

#include <vector>

#include "geometry/model/finding.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// A pole that is an arc on its faces gets two vertices in place of its one, where all edges there end at one end of
/// the arc: make_space_curves() then makes an edge of it. Each is said in `findings`. Cost: a look at each edge.
void split_vertices(ImportedShape& model, std::vector<ImportFinding>& findings);

}  // namespace st::occt
