// How many cells st-raster may make.
#pragma once

#include <cstdint>
#include <optional>

#include "comm/communicator.h"
#include "sizing/cell_limit.h"

namespace st {

struct CellBudget {
  std::uint64_t max_cells = kMaxIds;
  std::uint64_t max_samples = kMaxIds;  ///< of all ranks: what takes the same memory
};

/// Collective, the same on every rank. `max_cells`: what the user allows; nullopt: what fits 80 % of the memory of each
/// host, shared by its ranks, here and in st-prolong afterwards.
CellBudget make_cell_budget(std::optional<int> max_cells, const ModelLimits& limits, const Communicator& comm);

/// Collective, the same on every rank. Bytes.
double memory_of_all_hosts(const Communicator& comm);

/// Collective: the sum of all ranks on rank 0.
DepthLimit gather_depth_limit(const DepthLimit& own, const Communicator& comm);

}  // namespace st
