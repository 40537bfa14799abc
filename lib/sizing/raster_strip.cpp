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

/// Between two stations.
struct StripPlace {
  Vec3 x;
  double width;
  bool is_tapered;
};

StripPlace place_at(const Strip& strip, double share) {
  const double at = share * static_cast<double>(strip.stations.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), strip.stations.size() - 2);
  const Strip::Station &a = strip.stations[i], &b = strip.stations[i + 1];
  const double part = at - static_cast<double>(i);
  return {a.x + part * (b.x - a.x), a.width + part * (b.width - a.width),
          std::abs(b.width - a.width) > kTaper * distance(a.x, b.x)};
}

}  // namespace

void raster_strip(const Strip& strip, const SamplingLimits& limits, std::int32_t cause, std::vector<RasterBox>& boxes) {
  const double least_width = kResolved * limits.min_length;
  double share = 0;
  for (int n = 0; share <= 1 && n < kMaxBoxes; ++n) {
    const auto [x, width, is_tapered] = place_at(strip, share);
    const double least = is_tapered ? limits.min_length : kWidthsPerLength * least_width;
    const double length = std::clamp(kWidthsPerLength * width, least, limits.max_length);
    if (width > least_width && length < kWorthwhile * limits.max_length)
      boxes.push_back({x,
                       static_cast<float>(0.5 * limits.cell_per_length * length),
                       static_cast<float>(length),
                       cause,
                       {},
                       stretch_along([&](double at) { return place_at(strip, at).x; }, share, strip.length, length,
                                     {limits.max_aspect, limits.max_length, limits.alpha})});
    share += std::max(kSpacing * length / strip.length, 1.0 / kMaxBoxes);
  }
}

}  // namespace st
