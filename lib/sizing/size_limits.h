// The numbers that drive the sampling of curves and surfaces.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>

#include "base/vec.h"

namespace st {

/// How a curve or a face is sampled. Invariants: 0 < min_length <= max_length, 0 < alpha <= pi/2, 1 <= cell_per_length
/// <= 8, 0 < chord.
struct SamplingLimits {
  double min_length = 0;       ///< smallest sample length, model unit
  double max_length = 0;       ///< largest sample length, model unit
  double alpha = radians(10);  ///< largest turning of tangent or normal along one length, radians
  double cell_per_length = 2;  ///< edge of a raster box over its sample length
  double chord = std::numeric_limits<double>::infinity();  ///< largest distance of a length's chord from the geometry,
                                                           ///< model unit
  std::optional<int> gap_cells = std::nullopt;  ///< lengths across gaps in the flow; nullopt: gaps do not matter
  double gap_floor = 0;  ///< smallest length across gaps where that is below min_length, model unit; 0: it is not
  std::optional<int> wall_cells = std::nullopt;  ///< lengths across thin walls, inside the material; nullopt: walls do
                                                 ///< not matter
  std::optional<int> edge_cells = std::nullopt;  ///< lengths along each CAD edge at least, down to min_length; nullopt:
                                                 ///< one
  std::optional<int> chord_cells = std::nullopt;  ///< lengths along the local chord of a lifting surface at least;
                                                  ///< nullopt: the chord does not matter
  double max_aspect = 1;  ///< largest length along a direction in which the shape allows it, over the length across
  std::optional<double> max_along = std::nullopt;  ///< largest length along it, model unit; nullopt: max_length
  bool stretches_curve = false;                    ///< lengths along a curve are stretched, too
  bool has_own_min = false;                        ///< a rule gave min_length: nothing else moves it
  std::uint64_t max_samples = std::numeric_limits<std::int32_t>::max();  ///< of one curve or face; TooManyCells beyond
};

inline constexpr double kPatchFill = 0.9;  ///< largest extent of a patch over the edge of its raster box
inline constexpr double kProbeReach = 2;   ///< lengths per patch, however large the raster boxes: three probes cannot
                                           ///< see more

/// Lengths that a patch may have along its longest side, at most.
inline double patch_per_length(const SamplingLimits& limits) {
  return kPatchFill * std::min(limits.cell_per_length, kProbeReach);
}

/// The finest of each limit.
inline SamplingLimits finest(const SamplingLimits& a, const SamplingLimits& b) {
  SamplingLimits both = a;
  both.min_length = std::min(a.min_length, b.min_length);
  both.max_length = std::min(a.max_length, b.max_length);
  both.alpha = std::min(a.alpha, b.alpha);
  both.chord = std::min(a.chord, b.chord);
  both.gap_cells = std::max(a.gap_cells, b.gap_cells);
  both.wall_cells = std::max(a.wall_cells, b.wall_cells);
  both.edge_cells = std::max(a.edge_cells, b.edge_cells);
  both.min_length = std::min(both.min_length, both.max_length);
  both.max_aspect = std::min(a.max_aspect, b.max_aspect);
  both.stretches_curve = a.stretches_curve && b.stretches_curve;
  return both;
}

}  // namespace st
