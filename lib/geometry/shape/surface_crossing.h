// Where surfaces pass through each other, or one through itself.
#pragma once

#include <functional>
#include <optional>

#include "geometry/shape/surface.h"

namespace st {

/// A point of two surfaces, or of two places of one.
struct CommonPoint {
  Vec3 x;
  Vec2 uv_a, uv_b;
  double sine = 0;  ///< of the angle between both normals
};

/// By Newton's method from the guesses; both stay within their bounds. nullopt where it does not converge to
/// `precision` (model unit) in 30 steps, or one surface is singular there.
std::optional<CommonPoint> common_point(const Surface& a, Vec2 guess_a, const Surface& b, Vec2 guess_b,
                                        double precision);

/// Two distinct places of a surface at one point, through which it passes at an angle, further than `tolerance` (model
/// unit) from the sides of its bounds. `is_inside` tells what counts of the surface. Looked for on a grid: what is
/// smaller than its cells may be missed. Cost: some hundred evaluations where normals are within 75 degrees of
/// their mean, else up to some ten thousand.
std::optional<CommonPoint> find_self_crossing(const Surface& surface, double tolerance,
                                              const std::function<bool(Vec2)>& is_inside);

/// A point inside to which a line of constant u or v shrinks, no longer than `tolerance` (model unit), and beyond which
/// the surface is turned over: sides of a ribbon that pass each other, a tube that goes on inside out. Not a pole,
/// where a surface ends. Cost: some hundred evaluations.
std::optional<Vec3> find_pinch(const Surface& surface, double tolerance, const std::function<bool(Vec2)>& is_inside);

}  // namespace st
