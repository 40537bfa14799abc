// Joins faces that share no edges. Included inside lib/geometry only.
#pragma once

#include <vector>

#include "geometry/import_shape.h"

namespace st::occt {

/// Sews a model that has free edges; takes the smallest tolerance that closes it, else the one that leaves the fewest free edges. Faces,
/// their order and attributes stay. A model without free edges is not touched.
/// `stated_resolution`: tolerance that the file states, 0 when none. Lengths in the unit of the shape.
void sew_if_open(ImportedShape& model, double stated_resolution, std::vector<ImportFinding>& findings);

}  // namespace st::occt
