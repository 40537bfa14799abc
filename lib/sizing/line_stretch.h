// Longer lengths along a line: an edge, a nose, a strip.
#pragma once

#include <functional>
#include <limits>

#include "base/vec.h"
#include "sizing/octree.h"

namespace st {

/// How far lengths may be stretched.
struct StretchLimits {
  double max_aspect = 1;                                        ///< length along over length across
  double max_length = std::numeric_limits<double>::infinity();  ///< along, model unit
  double alpha = radians(10);                                   ///< turning along one length, radians
};

/// Length along over length across: less is no stretch.
inline constexpr double kLeastStretch = 1.2;

/// The stretch along a line of length `way` (model unit), at a share of it, where `across` is requested: the line turns
/// by no more than alpha along one length, and leaves its chord by a share of `across`. `point_at` takes shares in
/// [0, 1].
SampleStretch stretch_along(const std::function<Vec3(double)>& point_at, double share, double way, double across,
                            const StretchLimits& limits);

}  // namespace st
