// Facets of a face between two poles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/model/model_tables.h"
#include "geometry/shape/chart_topology.h"

namespace st {

/// [n_edges] 1: some face has a pole at either end of the edge.
std::vector<std::uint8_t> edges_between_poles(const ModelTables& tables);

/// A chain of nodes from one pole to the other.
struct PoleChain {
  std::vector<std::int32_t> node;  ///< at least one beside the poles; both chains begin and end at the same node
  std::vector<double> at;          ///< [n] place between the poles, ascending; any unit, the same for both chains
};

/// Fills what is between two chains: each facet has nodes of both, or a pole; none is at both poles. Seen with `left`
/// on the left on the way from the first pole, they are counter-clockwise.
std::vector<Corners> fill_pole_band(const PoleChain& left, const PoleChain& right);

}  // namespace st
