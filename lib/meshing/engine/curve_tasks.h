// Nodes on many curves, made on all ranks.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/executor.h"
#include "mesh/edge_mesh.h"

namespace st {

/// Collective. `make(i)` for i in [0, n), each on any rank; the results on every rank. `make` is pure.
std::vector<CurveNodes> make_curve_nodes(std::int32_t n, const std::function<CurveNodes(std::int32_t i)>& make,
                                         const Executor& executor);

}  // namespace st
