#include "sizing/crossing_parts.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace st {
namespace {

constexpr double kLeastSlope = 0.05;  // between the walls: flatter ones are a gap for long
constexpr double kBeyond = 1.25;      // of the way to where both walls would meet, if they were flat
constexpr int kSteps = 5;             // of that
constexpr double kClosing = 0.8;      // of the width before the step, at most: else there is a throat

bool may_cross(const GapPatch& p) { return p.stretch.max_aspect > 1 && p.solid >= 0; }

}  // namespace

CrossingParts::CrossingParts(std::span<const GapPatch> patches) : patches_(patches) {
  const auto first = std::ranges::find_if(patches, may_cross);
  const auto is_other = [&](const GapPatch& p) { return may_cross(p) && p.solid != first->solid; };
  if (first == patches.end() || std::ranges::none_of(patches, is_other)) return;
  std::vector<Box3> boxes;
  for (const GapPatch& p : patches) boxes.push_back(p.shape.box());
  tree_ = BoxTree(boxes);
}

bool CrossingParts::cross_where_closed(const GapPatch& own, const GapPatch& other, Vec3 x, double d) const {
  if (tree_.is_empty() || !may_cross(own) || other.solid < 0 || other.solid == own.solid) return false;
  Vec3 n = own.shape.normal_beside(x), opposite = other.shape.normal_beside(x + d * n);
  for (int i = 0; i < kSteps; ++i) {
    const Vec3 closing = (dot(opposite, n) * n - opposite) / std::abs(dot(opposite, n));  // the slope, as a vector
    const double slope = norm(closing);
    if (!(slope > kLeastSlope)) return false;
    const double step = std::max(kBeyond * d / slope, own.min_length);
    x = x + step / slope * closing;
    const std::optional<Above> here = nearest_below(own.solid, x, step);
    if (!here) return false;
    n = here->patch->shape.normal_beside(x);
    x = x - here->height * n;
    const std::optional<Above> there = nearest_below(other.solid, x, step);
    if (!there) return false;
    if (there->height < 0) return true;
    if (there->height > kClosing * d) return false;
    d = there->height;
    opposite = there->patch->shape.normal_beside(x);
  }
  return false;
}

/// Of the patches of a solid over which a place lies, inside their loops, no further than `reach` from them.
std::optional<CrossingParts::Above> CrossingParts::nearest_below(std::int32_t solid, Vec3 x, double reach) const {
  std::optional<Above> nearest;
  tree_.visit_near(
      x, [&](std::int32_t, double d2) { return d2 <= reach * reach; },  // the foot of a height is in the box
      [&](std::int32_t i) {
        if (patches_[i].solid != solid) return;
        const Paraboloid& p = patches_[i].shape;
        const Vec3 to = x - p.x;
        const double s = dot(to, p.axis_s), t = dot(to, p.axis_t);
        if (!(s >= p.s_lo && s <= p.s_hi && t >= p.t_lo && t <= p.t_hi) || !p.is_inside(s, s, t, t)) return;
        const double height = dot(to, p.normal) - p.height(s, t);
        if (std::abs(height) > reach || (nearest && std::abs(height) == reach)) return;
        nearest = {&patches_[i], height};
        reach = std::abs(height);
      });
  return nearest;
}

}  // namespace st
