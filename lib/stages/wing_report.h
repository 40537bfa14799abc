// What st-raster says of trailing edges that make no lifting surface.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "features/lifting_surface.h"

namespace st {

/// Above this share of the reference diagonal trailing edges without a lifting surface are worth a warning.
inline constexpr double kLongTrailing = 0.05;

/// One line for each, the longest first, `most` at most, and one for the others.
std::vector<std::string> unused_lines(std::span<const UnusedTrailing> unused, std::size_t most);

/// Which long ones have the lengths of all other edges, and the rule that gives them their own; empty: there are none.
std::string unused_warning(std::span<const UnusedTrailing> unused, double reference_diagonal);

/// `unused_trailing` of --json: edges from 1, length, reason.
nlohmann::json unused_json(std::span<const UnusedTrailing> unused);

}  // namespace st
