// Edges across which the surface goes on smoothly: where the CAD happens to be split.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/model/model.h"

namespace st {

/// [n_edges] 1: two coedges use the edge, of two faces or along a seam, and at nine places on it the normals on both
/// sides differ by 3 degrees at most. Degenerate edges are not smooth. Local. Cost: 18 evaluations per edge.
std::vector<std::uint8_t> find_smooth_edges(const Model& model);

}  // namespace st
