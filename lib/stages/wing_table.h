// How st-check and st-report say what lifting surfaces have: text, JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "stages/wing_measure.h"

namespace st {

/// A line for each surface below a heading; lengths are per cents of the local chord, across the edge, and along it too
/// where sizes are stretched. Empty: there is none.
std::string wing_table(std::span<const WingMeasure> wings, bool is_stretched);

/// A line for each of the first surfaces: what is at noses and trailing edges, and what was asked for.
std::string wing_lines(std::span<const WingMeasure> wings);

/// Lengths in model unit.
nlohmann::json wing_measures_json(std::span<const WingMeasure> wings);

/// Places where the mesh is coarser than 1.5 times what was asked for: those of the five stations, and the worst.
std::vector<WingMiss> find_misses(std::span<const WingMeasure> wings);

}  // namespace st
