// What the import says of the model: what is open, not manifold, small, invalid.
#pragma once

#include "geometry/import/import.h"
#include "geometry/model/model_state.h"
#include "geometry/model/model_tables.h"

namespace st::occt {

/// Fills counts, area, volume, is_closed and findings of `result`, whose tables are complete. `small` (model unit):
/// edges shorter and faces narrower than this are listed.
void report_topology(const ImportedShape& model, const FaceMeasures& measures, double small, ImportResult& result);

/// Fills edge_uses and is_closed, and adds a finding for each edge that not exactly two faces use, one each way.
void report_uses(ImportResult& result);

/// Adds a finding for each optional group without members.
void report_groups(const std::vector<EmptyGroup>& groups, ImportResult& result);

/// Throws Error(kGeometry) unless the model is closed.
void require_closed(const ImportResult& result, const std::string& path);

/// Adds a finding for each face, shell and solid that OpenCASCADE's checker calls invalid. About 0.4 ms per face.
void report_validity(const ImportedShape& model, ImportResult& result);

}  // namespace st::occt
