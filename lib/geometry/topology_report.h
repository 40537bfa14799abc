// What the import says of the model: what is open, what is not manifold. Included inside lib/geometry only.
#pragma once

#include "geometry/import_shape.h"

namespace st::occt {

/// Fills counts, area, volume, is_closed and the findings of `result`, whose tables are complete.
void report_topology(const ImportedShape& model, ImportResult& result);

}  // namespace st::occt
