#include "sizing/raster_tip.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace st {
namespace {

constexpr double kWidths = 0.36;     // of a length: where the face is wider no angle is below 20 degrees
constexpr double kSharp = 6;         // lengths over width: the edges meet in less than 10 degrees
constexpr double kSamePoint = 1e-6;  // of the smallest length
constexpr double kBelow = 0.999;     // of the largest length: rules may ask for that

using Loop = std::span<const SpaceSide>;

/// A corner, and how wide the face is at some distances from it.
struct Tip {
  Vec3 x;
  std::vector<double> distance, width;  // ascending; model unit

  /// Infinite where the face is no tip any more.
  double width_at(double d) const {
    const auto next = std::upper_bound(distance.begin(), distance.end(), d);
    if (next == distance.end()) return std::numeric_limits<double>::infinity();
    const auto i = static_cast<std::size_t>(next - distance.begin());
    return std::lerp(width[i - 1], width[i], (d - distance[i - 1]) / (distance[i] - distance[i - 1]));
  }
};

/// The sides up to the next place where they do not go on.
Loop first_loop(std::span<const SpaceSide> sides, double same) {
  std::size_t n = 1;
  while (n < sides.size() && distance(sides[n - 1].end(), sides[n].a) <= same) ++n;
  return sides.first(n);
}

/// From x to the nearest place on the sides up to `i`, no further along the loop than `reach`.
Vec3 way_across(Loop loop, std::size_t i, std::size_t n_most, double reach, Vec3 x) {
  Vec3 nearest{std::numeric_limits<double>::infinity(), 0, 0};
  double along = 0;
  for (std::size_t m = 0; m < n_most && along < reach; ++m) {
    const SpaceSide& side = loop[(i + loop.size() - m) % loop.size()];
    const Vec3 way = side.nearest_to(x) - x;
    if (norm2(way) < norm2(nearest)) nearest = way;
    along += side.length;
  }
  return nearest;
}

/// At the end of side `i`, as far as the face is narrow.
Tip tip_at(Loop loop, std::size_t i, const SamplingLimits& limits) {
  Tip tip{loop[i].end(), {0}, {0}};
  double along = 0;
  for (std::size_t k = 1; 2 * k <= loop.size(); ++k) {
    const SpaceSide& side = loop[(i + k) % loop.size()];
    along += side.length;
    const Vec3 across = way_across(loop, i, loop.size() - k, 2 * along, side.end());
    const double width = norm(across), from_tip = distance(tip.x, side.end());
    const bool is_notch_or_seam = !(dot(across, side.inward) > 0) || width < kSamePoint * limits.min_length;
    if (is_notch_or_seam || kSharp * width > from_tip || from_tip <= tip.distance.back()) break;
    tip.distance.push_back(from_tip);
    tip.width.push_back(width);
    if (width > kWidths * limits.max_length) break;
  }
  return tip;
}

std::vector<Tip> find_tips(std::span<const SpaceSide> sides, const SamplingLimits& limits) {
  const double same = kSamePoint * limits.min_length;
  std::vector<Tip> tips;
  while (!sides.empty()) {
    const Loop loop = first_loop(sides, same);
    sides = sides.subspan(loop.size());
    if (distance(loop.back().end(), loop.front().a) > same) continue;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      if (loop[i].coedge == loop[(i + 1) % loop.size()].coedge) continue;
      Tip tip = tip_at(loop, i, limits);
      if (tip.distance.size() > 1) tips.push_back(std::move(tip));
    }
  }
  return tips;
}

}  // namespace

void drop_tips(std::span<const SpaceSide> sides, const SamplingLimits& limits, std::size_t first,
               std::vector<RasterBox>& boxes) {
  const std::vector<Tip> tips = find_tips(sides, limits);
  if (tips.empty()) return;
  const auto is_in_tip = [&](const RasterBox& box) {
    return box.length < kBelow * limits.max_length && std::any_of(tips.begin(), tips.end(), [&](const Tip& t) {
             return t.width_at(distance(t.x, box.center)) < kWidths * box.length;
           });
  };
  boxes.erase(std::remove_if(boxes.begin() + static_cast<std::ptrdiff_t>(first), boxes.end(), is_in_tip), boxes.end());
}

}  // namespace st
