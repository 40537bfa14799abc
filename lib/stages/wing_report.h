// What st-raster says of lifting surfaces, and of trailing edges that make none.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "features/lifting_surface.h"

namespace st {

/// Above this share of the reference diagonal trailing edges without a lifting surface are worth a warning.
inline constexpr double kLongTrailing = 0.05;

/// Share of the span: stretches without a nose up to this length are not worth a warning, as tips and roots may lack
/// some stations; all of a surface together are above it.
inline constexpr double kShortStretch = 0.02;

/// One line for each, the longest first, `most` at most, and one for the others.
std::vector<std::string> unused_lines(std::span<const UnusedTrailing> unused, std::size_t most,
                                      const std::string& unit = "");

/// Of how many sets of trailing edges how many make lifting surfaces, and why others do not; empty: all do.
std::string used_line(std::size_t n_wings, std::span<const UnusedTrailing> unused);

/// That a rule names edges that are none, and why.
std::string declared_warning(const UnusedTrailing& declared);

/// Which long ones have the lengths of all other edges, and the rule that gives them their own; empty: there are none.
std::string unused_warning(std::span<const UnusedTrailing> unused, double reference_diagonal,
                           const std::string& unit = "");

/// One line on a lifting surface.
std::string wing_line(const LiftingSurface& wing, const std::string& edge_size, const std::string& unit = "");

/// Surfaces whose noses are not seen, and stretches of edges before which they are not, and what to do; empty: there
/// are none.
std::string noseless_warning(std::span<const LiftingSurface> wings);

/// Edges of sheets, and seams of blades, at which no lifting surface is looked for, and the rule that gives them
/// lengths; empty: there are none.
std::string sheet_warning(std::span<const EdgeId> free_edges);
std::string seam_warning(std::span<const EdgeId> seams);

/// `lifting_surfaces` of --json.
nlohmann::json wings_json(std::span<const LiftingSurface> wings);

/// `unused_trailing` of --json: edges from 1, length, reason.
nlohmann::json unused_json(std::span<const UnusedTrailing> unused);

}  // namespace st
