// From facets to a model: mended, split into faces, each with parameters.
#pragma once

#include <string>

#include "geometry/facet/facet_mesh.h"
#include "geometry/import/import.h"

namespace st {

/// Of `options` are used unit (which is needed: facets have none), small, groups, feature_deg, smooth, check_only and
/// require_closed. `input` is left mended and smooth, as the model has it but for what is cut. `path` for messages.
/// Throws Error(kUsage) for another option and without a unit, Error(kGeometry) where nothing is left or no side is
/// outside.
ImportResult import_facets(FacetInput& input, const ImportOptions& options, const std::string& path);

}  // namespace st
