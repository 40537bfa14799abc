// Nodes on many curves, made on all ranks.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/executor.h"
#include "mesh/edge_mesh.h"

namespace st {

/// Collective. `make(i)`, the nodes of one curve, for i in [0, n), each on any rank; all on every rank. `make` is pure.
EdgeMesh make_curve_nodes(std::int32_t n, const std::function<EdgeMesh(std::int32_t i)>& make,
                          const Executor& executor);

}  // namespace st
