// Walls of the CAD that keep away from each other, although triangles of them cross.
#pragma once

#include <array>
#include <optional>

#include "geometry/shape/surface.h"

namespace st {

/// A triangle of a face with the (u,v) of its corners.
struct WallTriangle {
  std::array<Vec3, 3> x;
  std::array<Vec2, 3> uv;
};

/// How far two surfaces are apart where triangles of them cross.
struct WallGap {
  bool is_apart = false;  ///< they do not meet within the triangles
  double factor = 1;      ///< of the triangles' lengths: so short, their chords do not meet either
};

/// Distance of the surfaces where the triangles cross, and how far these are off their surfaces: a chord's distance
/// falls with its length squared. Surfaces closer than `tolerance` (model unit), and those that come closer and closer
/// within the triangles, meet. nullopt where a projection fails.
std::optional<WallGap> measure_gap(const Surface& a, const WallTriangle& of_a, const Surface& b,
                                   const WallTriangle& of_b, double tolerance);

}  // namespace st
