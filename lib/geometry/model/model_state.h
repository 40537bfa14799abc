// How a model's faces hang together, and what they enclose.
#pragma once

#include <vector>

#include "geometry/model/finding.h"
#include "geometry/model/model.h"

namespace st {

/// Edges that not exactly two faces use, one each way; those of poles left out.
struct EdgeUses {
  int n_free = 0;                       ///< used once
  int n_nonmanifold = 0;                ///< used three times or more
  int n_contradictory = 0;              ///< used twice, the same way: its faces disagree which side is outside
  std::vector<ImportFinding> findings;  ///< one for each, in the order of their ids
};
EdgeUses report_edge_uses(const ModelTables& tables);

/// At least one face in a shell, no free edge, and none at which both faces disagree which side is outside.
bool is_closed(const ModelTables& tables, const EdgeUses& uses);

/// Volume that a closed model without faces between solids encloses, model unit cubed; negative where normals point
/// inward. Relative error below 1e-5; about 0.1 ms per face.
double enclosed_volume(const Model& model);

}  // namespace st
