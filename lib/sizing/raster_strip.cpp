#include "sizing/raster_strip.h"

#include <algorithm>
#include <cmath>

#include "sizing/line_stretch.h"

namespace st {
namespace {

constexpr double kWidthsPerLength = 1.25;  // of the triangles: right-angled ones have a quality of 0.85, others more
constexpr double kResolved = 0.17;         // of the smallest length: narrower strips are not worth resolving
constexpr double kTaper = 0.05;            // width over length; towards a point triangles are as flat at any size
constexpr double kWorthwhile = 0.9;        // of the largest length: more asks for nothing
constexpr double kSpacing = 1;             // lengths between two boxes
constexpr int kMaxBoxes = 20000;           // per strip

/// Whether the width changes along the way; `share`: of it.
bool is_tapered(const Strip& strip, double share) {
  const double n = static_cast<double>(strip.stations.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(share * n), strip.stations.size() - 2);
  const Strip::Station &a = strip.stations[i], &b = strip.stations[i + 1];
  return std::abs(b.width() - a.width()) > kTaper * distance(a.x, b.x);
}

}  // namespace

void raster_strip(const Strip& strip, const SamplingLimits& limits, std::int32_t cause, std::vector<RasterBox>& boxes) {
  const double least_width = kResolved * limits.min_length;
  double share = 0;
  for (int n = 0; share <= 1 && n < kMaxBoxes; ++n) {
    const Strip::Station station = strip.at(share);
    const double width = station.width();
    const double least = is_tapered(strip, share) ? limits.min_length : kWidthsPerLength * least_width;
    const double length = std::clamp(kWidthsPerLength * width, least, limits.max_length);
    const double step = std::max(kSpacing * length / strip.length, 1.0 / kMaxBoxes);
    if (width > least_width && strip.tells(width) && length < kWorthwhile * limits.max_length)
      boxes.push_back({station.middle(),
                       static_cast<float>(0.5 * limits.cell_per_length * length),
                       static_cast<float>(length),
                       cause,
                       {},
                       stretch_along([&](double at) { return strip.at(at).x; }, share, strip.length, length,
                                     {limits.max_aspect, limits.max_length, limits.alpha}),
                       reach_of(0.5 * (strip.at(std::min(share + 0.5 * step, 1.0)).x -
                                       strip.at(std::max(share - 0.5 * step, 0.0)).x),
                                0.5 * station.across)});
    share += step;
  }
}

}  // namespace st
