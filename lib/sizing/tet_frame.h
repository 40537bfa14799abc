// Places in a tetrahedron of a background mesh, and what is linear there.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "sizing/background.h"

namespace st {

/// A tetrahedron that has no frame.
inline bool is_flat(const std::array<Vec3, 4>& p) {
  constexpr double kFlat = 1e-12;  // six volumes over the cubed edge
  const Vec3 a = p[1] - p[0], b = p[2] - p[0], c = p[3] - p[0];
  const double volume6 = dot(cross(a, b), c), longest = std::max({norm(a), norm(b), norm(c)});
  return !(std::abs(volume6) > kFlat * longest * longest * longest);
}

/// Barycentric coordinates 1 to 3 of x are row . (x - corner); coordinate 0 is the rest to 1.
struct TetFrame {
  Vec3 corner;
  Vec3 row[3];

  /// Of one that is not flat.
  explicit TetFrame(const std::array<Vec3, 4>& p) : corner(p[0]) {
    const Vec3 a = p[1] - p[0], b = p[2] - p[0], c = p[3] - p[0];
    const double volume6 = dot(cross(a, b), c);
    row[0] = cross(b, c) / volume6;
    row[1] = cross(c, a) / volume6;
    row[2] = cross(a, b) / volume6;
  }
  std::array<double, 4> coordinates(Vec3 x) const {
    const Vec3 r = x - corner;
    const double b = dot(row[0], r), c = dot(row[1], r), d = dot(row[2], r);
    return {1 - b - c - d, b, c, d};
  }
  Vec3 gradient(const std::array<double, 4>& value) const {
    return (value[1] - value[0]) * row[0] + (value[2] - value[0]) * row[1] + (value[3] - value[0]) * row[2];
  }
};

/// Places of the nodes of a tetrahedron, and its smallest lengths there.
inline std::array<Vec3, 4> corners_of(const BackgroundMesh& mesh, const std::array<std::int32_t, 4>& tet) {
  return {mesh.node_xyz[tet[0]], mesh.node_xyz[tet[1]], mesh.node_xyz[tet[2]], mesh.node_xyz[tet[3]]};
}

inline std::array<double, 4> lengths_of(const BackgroundMesh& mesh, const std::array<std::int32_t, 4>& tet) {
  const auto& s = mesh.node_size;
  return {s[tet[0]].length, s[tet[1]].length, s[tet[2]].length, s[tet[3]].length};
}

}  // namespace st
