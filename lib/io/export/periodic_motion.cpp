#include "io/export/periodic_motion.h"

#include <array>
#include <cmath>

namespace st {
namespace {

constexpr double kNoTurn = 1e-12;  // radians: moves no node by more than pairs may differ

/// Unit vector along the axis, by the half of R that does not vanish at this angle: sin [u]x, or, beyond a quarter
/// turn, (1 - cos) u u^T. `antisymmetric`: sin u.
Vec3 axis_of(const std::array<Vec3, 3>& r, Vec3 antisymmetric, double cosine) {
  if (cosine > 0) return normalized(antisymmetric);
  const double xy = 0.5 * (r[0].y + r[1].x), xz = 0.5 * (r[0].z + r[2].x), yz = 0.5 * (r[1].z + r[2].y);
  Vec3 longest;
  for (const Vec3 column :
       {Vec3{r[0].x - cosine, xy, xz}, Vec3{xy, r[1].y - cosine, yz}, Vec3{xz, yz, r[2].z - cosine}})
    if (norm(column) > norm(longest)) longest = column;
  return normalized(dot(longest, antisymmetric) < 0 ? -1 * longest : longest);
}

/// Of R = Rz Ry Rx; where y is a quarter turn, x and z turn alike, and z is 0.
Vec3 turns_of(const std::array<Vec3, 3>& r) {
  const double cosine = std::hypot(r[0].x, r[1].x), y = std::atan2(-r[2].x, cosine);
  if (cosine < kNoTurn) return {std::atan2(-r[1].z, r[1].y), y, 0};
  return {std::atan2(r[2].y, r[2].z), y, std::atan2(r[1].x, r[0].x)};
}

}  // namespace

PeriodicMotion periodic_motion(const Similarity& motion) {
  const auto& r = motion.rotation;
  const Vec3 antisymmetric = 0.5 * Vec3{r[2].y - r[1].z, r[0].z - r[2].x, r[1].x - r[0].y};
  const double cosine = 0.5 * (r[0].x + r[1].y + r[2].z - 1), angle = std::atan2(norm(antisymmetric), cosine);
  const Vec3 t = motion.translation;
  if (angle < kNoTurn) return {{}, {}, t};
  const Vec3 u = axis_of(r, antisymmetric, cosine), along = dot(u, t) * u, across = t - along;
  PeriodicMotion result{0.5 * (across + 1 / std::tan(0.5 * angle) * cross(u, across)), turns_of(r), along, false};
  for (const Vec3 own : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
    if (angle * norm(cross(u, own)) < kNoTurn) {
      result.turns = (dot(u, own) < 0 ? -angle : angle) * own;
      result.has_own_axis = true;
    }
  return result;
}

}  // namespace st
