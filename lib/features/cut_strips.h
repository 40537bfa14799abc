// Strips of facets: where charts are cut, their long edges are in pieces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "features/strip.h"
#include "geometry/model/model.h"

namespace st {

/// Strips as find_strips() would find them if edges went on where a smooth edge ends at them, as cuts between charts
/// do; without those that it finds. `edges` are the first pieces of both sides. Ascending by face; none in a CAD model.
/// `is_smooth`: [n_edges]. Local.
std::vector<Strip> find_cut_strips(const Model& model, std::span<const std::uint8_t> is_smooth);

}  // namespace st
