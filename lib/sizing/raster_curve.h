// Sample lengths along a curve.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/shape/curve.h"
#include "sizing/octree.h"
#include "sizing/size_limits.h"

namespace st {

/// A curve measured: arc length and turning of the tangent as functions of the parameter, linear between entries.
/// Entries are so dense that the tangent turns by at most alpha/4 between two of them (or they are min_length/4 apart),
/// and never further apart than max_length/2.
struct CurveTable {
  std::vector<double> t;        ///< parameter, strictly ascending; first and last are the curve's bounds
  std::vector<double> s;        ///< arc length from the start, model unit
  std::vector<double> turning;  ///< turning of the tangent from the start, radians; the jump at a corner does not count
  std::vector<std::size_t> corners;  ///< entries at which a corner (jump of the tangent by more than alpha) has its
                                     ///< near side; the next entry is its far side
};

/// Measures a curve. Throws TooManyCells when that takes more than max_samples entries. Cost: some ten evaluations per
/// sample length.
CurveTable measure_curve(const Curve& curve, const SamplingLimits& limits);

/// Cuts the curve into consecutive segments with arc length in [min_length, max_length] whose tangent turns by at most
/// alpha unless that would undercut min_length (Deister et al. 2004, section 2.1); corners end a segment. Appends one
/// raster box per segment: centre in the middle of the segment, length = chord, not longer than the whole curve,
/// clamped to the limits, and to 1/edge_cells of the curve down to min_length. The last, shorter piece takes the length
/// that its turning allows.
void raster_curve(const Curve& curve, const SamplingLimits& limits, std::int32_t cause, std::vector<RasterBox>& boxes);

}  // namespace st
