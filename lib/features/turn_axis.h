// The axis about which blades turn onto one another.
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "base/eigen.h"
#include "base/similarity.h"
#include "base/vec.h"

namespace st {

/// A line about which blades turn.
struct TurnAxis {
  Vec3 center, axis;  // unit
  std::array<Vec3, 2> across;

  TurnAxis(Vec3 at, Vec3 along) : center(at), axis(along) {
    const Vec3 other = std::abs(along.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    across[0] = normalized(cross(along, other));
    across[1] = cross(along, across[0]);
  }
  double azimuth(Vec3 x) const { return std::atan2(dot(x - center, across[1]), dot(x - center, across[0])); }
  double height(Vec3 x) const { return dot(x - center, axis); }
  double radius(Vec3 x) const { return norm(x - center - height(x) * axis); }
  Similarity turn(double angle) const { return rotation_about(axis, angle).about(center); }
};

/// The axis of a motion, unless that moves along it by more than `slip`, model unit, or turns by less than a degree:
/// copies in one place.
inline std::optional<TurnAxis> axis_of(const Similarity& motion, double slip) {
  constexpr double kLeastTurn = radians(1);
  const auto& r = motion.rotation;
  Eigen::Matrix3d turn;
  for (int i = 0; i < 3; ++i) turn.row(i) = to_eigen(r[static_cast<std::size_t>(i)]);
  const Vec3 axis = principal_axes(turn + turn.transpose()).axis[2];
  const Vec3 twice_sine{r[2].y - r[1].z, r[0].z - r[2].x, r[1].x - r[0].y};
  const double angle = std::atan2(0.5 * dot(axis, twice_sine), 0.5 * (r[0].x + r[1].y + r[2].z - 1));
  const double along = dot(axis, motion.translation);
  if (std::abs(angle) < kLeastTurn || std::abs(along) > slip) return std::nullopt;
  const Vec3 way = motion.translation - along * axis;
  return TurnAxis(0.5 * (way + cross(axis, way) / std::tan(0.5 * angle)), axis);
}

}  // namespace st
