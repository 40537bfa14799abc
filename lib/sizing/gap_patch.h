// A sampled patch of a face, as gaps see it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/vec.h"
#include "sizing/line_stretch.h"

namespace st {

/// A small piece of a paraboloid: x + s * axis_s + t * axis_t + height(s, t) * normal for (s, t) in [s_lo, s_hi] x
/// [t_lo, t_hi]. The axes are unit and orthogonal.
struct Paraboloid {
  Vec3 x;                                    ///< on the surface, model unit
  Vec3 normal;                               ///< unit, out of the material
  Vec3 axis_s, axis_t;                       ///< along u and v, roughly
  double s_lo = 0, s_hi = 0;                 ///< model unit
  double t_lo = 0, t_hi = 0;                 ///< model unit
  double k_ss = 0, k_st = 0, k_tt = 0;       ///< second derivatives of the height, 1/model unit
  std::uint64_t inside = ~std::uint64_t{0};  ///< bit 8 * row + column: that of 8 x 8 cells lies inside the loops; rows
                                             ///< along t

  /// Turns the normal round.
  void flip() { normal = -normal, k_ss = -k_ss, k_st = -k_st, k_tt = -k_tt; }
  /// How far a round surface is off the paraboloid at its rim, model unit.
  double sagging() const;
  double height(double s, double t) const { return 0.5 * (k_ss * s * s + k_tt * t * t) + k_st * s * t; }
  Vec3 point(double s, double t) const { return x + s * axis_s + t * axis_t + height(s, t) * normal; }
  /// Unit normal of the paraboloid, to the same side as `normal`.
  Vec3 normal_at(double s, double t) const;
  /// Likewise above or below a place.
  Vec3 normal_beside(Vec3 place) const { return normal_at(dot(place - x, axis_s), dot(place - x, axis_t)); }
  /// Does any of [s0, s1] x [t0, t1] lie inside the loops, by cells?
  bool is_inside(double s0, double s1, double t0, double t1) const;
  /// Box of the paraboloid.
  Box3 box() const;
  /// Distance along `direction` (unit) from `from` to the patch, either sign, where the ray meets it inside the loops
  /// from the side to which the normals are opposed by more than 135 degrees.
  std::optional<double> facing_distance(Vec3 from, Vec3 direction) const;
};

/// A patch, and what it asks for.
struct GapPatch {
  Paraboloid shape;
  double length = 0;              ///< that the patch asks for otherwise, model unit
  double min_length = 0;          ///< floor, model unit
  double slot_floor = 0;          ///< likewise of a patch on the other side, where less; 0: that keeps its own
  bool keeps_floor = false;       ///< whatever slot_floor the other side has
  std::optional<int> gap_cells;   ///< lengths across gaps, ahead; nullopt: these do not matter
  std::optional<int> wall_cells;  ///< lengths across walls, behind; nullopt: these do not matter
  StretchLimits stretch;
  Vec3 way;                 ///< unit, along which the patch's own lengths are longer; zero: along none
  Vec3 end;                 ///< unit, along an edge near at which the surface ends; zero: none is
  std::int32_t cause = 0;   ///< packed
  std::int32_t solid = -1;  ///< that the face bounds; -1: none
};

/// The paraboloid through the middle of 3 x 3 points (rows in v) with the normal there that fits the others best.
/// `normal` is unit.
Paraboloid fit_patch(const std::array<Vec3, 9>& points, Vec3 normal);

/// Cosine between normals of surfaces that face each other: below (a V of 60 degrees is no gap).
inline constexpr double kFacing = -0.71;

}  // namespace st
