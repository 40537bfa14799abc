// Flat tables of a B-Rep. Included inside lib/geometry only.
#pragma once

#include <string>

#include "geometry/import_shape.h"

namespace st::occt {

/// Tables of `model`: ids in TopExp order; unit and findings are left to the caller. Throws Error(kGeometry) naming `path` for an edge
/// without a vertex.
ModelTables make_tables(const ImportedShape& model, const std::string& path);

}  // namespace st::occt
