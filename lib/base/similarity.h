// Motions that keep angles: turning, mirroring, scaling alike in all directions, moving.
#pragma once

#include <array>
#include <string>

#include "base/vec.h"

namespace st {

/// Coordinates of models, in their unit: a million kilometres in mm. Lengths have no digits left beyond.
inline constexpr double kLargestCoordinate = 1e12;

/// Rotation or reflection, then scaling in common, then translation.
struct Similarity {
  std::array<Vec3, 3> rotation{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< rows; orthonormal, left-handed where it mirrors
  double scale = 1;                                                 ///< > 0
  Vec3 translation{};                                               ///< model unit

  Vec3 rotated(Vec3 v) const { return {dot(rotation[0], v), dot(rotation[1], v), dot(rotation[2], v)}; }
  Vec3 operator()(Vec3 x) const { return scale * rotated(x) + translation; }
  /// This one first, then `next`.
  Similarity then(const Similarity& next) const;
  /// Moves this one in the same way, of which `point` is the origin.
  Similarity about(Vec3 point) const;
  Similarity inverse() const;
  bool is_mirrored() const { return dot(rotation[0], cross(rotation[1], rotation[2])) < 0; }
  bool operator==(const Similarity&) const = default;
};

/// Rotation by `angle` (radians, right-handed) about the axis through the origin.
Similarity rotation_about(Vec3 axis, double angle);

/// Reflection at the plane through the origin with this normal.
Similarity reflection_at(Vec3 normal);

/// Steps in order, separated by ';' (angles in degrees, right-handed; `at` a point on the axis or plane, or the one
/// that stays; else the origin): "rotate X Y Z DEGREES [at X Y Z]", "hinge X Y Z X Y Z DEGREES" (about the line through
/// two points), "mirror X Y Z [at X Y Z]" (X Y Z: normal of the plane), "scale F [at X Y Z]", "translate X Y Z". No
/// step: nothing moves. Throws Error(kUsage) naming `option`.
Similarity parse_similarity(const std::string& text, const std::string& option);

}  // namespace st
