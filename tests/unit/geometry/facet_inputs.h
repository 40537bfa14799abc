// Facets of simple bodies.
#pragma once

#include <array>
#include <cmath>
#include <map>

#include "geometry/facet/facet_mesh.h"

namespace st::test {

/// A closed grid of n_u x n_v quadrangles; points in one place are one node.
template <class Point>
FacetInput grid_facets(int n_u, int n_v, const Point& point) {
  FacetInput in;
  in.part_name = {""};
  std::map<std::array<double, 3>, std::int32_t> known;
  const auto node = [&](int i, int j) {
    const Vec3 x = point(i, j);
    const auto [it, is_new] = known.emplace(std::array{x.x, x.y, x.z}, static_cast<std::int32_t>(in.x.size()));
    if (is_new) in.x.push_back(x);
    return it->second;
  };
  for (int i = 0; i < n_u; ++i)
    for (int j = 0; j < n_v; ++j) {
      const std::int32_t a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
      for (const Corners& t : {Corners{a, b, c}, Corners{a, c, d}})
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) in.corners.push_back(t);
    }
  in.part.assign(in.corners.size(), 0);
  return in;
}

inline FacetInput sphere_facets(int n, double radius = 1, Vec3 center = {}) {
  return grid_facets(2 * n, n, [=](int i, int j) {
    const double a = kPi * (i % (2 * n)) / n, b = kPi * j / n;
    if (j == 0 || j == n) return center + Vec3{0, 0, j == 0 ? -radius : radius};
    return center + radius * Vec3{std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), -std::cos(b)};
  });
}

inline FacetInput torus_facets(int n_u, int n_v, double large = 3, double small = 1) {
  return grid_facets(n_u, n_v, [=](int i, int j) {
    const double a = 2 * kPi * (i % n_u) / n_u, b = 2 * kPi * (j % n_v) / n_v, r = large + small * std::cos(b);
    return Vec3{r * std::cos(a), r * std::sin(a), small * std::sin(b)};
  });
}

/// The skin of a wing of chord 1 along x and span 4 along y, open at both ends, from its sharp trailing edge at x = 1
/// around the nose and back.
inline FacetInput skin_facets(int n_around, int n_along) {
  return grid_facets(n_around, n_along, [=](int i, int j) {
    const double a = 2 * kPi * (i % n_around) / n_around, x = 0.5 + 0.5 * std::cos(a);
    return Vec3{x, 4.0 * j / n_along,
                i % n_around == 0 ? 0 : 0.1 * std::sqrt(x) * (1 - x) * (std::sin(a) > 0 ? 1 : -1)};
  });
}

inline FacetInput cube_facets() {
  FacetInput in;
  for (int n = 0; n < 8; ++n) in.x.push_back({n & 4 ? 1.0 : 0.0, n & 2 ? 1.0 : 0.0, n & 1 ? 1.0 : 0.0});
  for (const auto& q : {std::array{0, 1, 3, 2}, std::array{4, 6, 7, 5}, std::array{0, 4, 5, 1}, std::array{2, 3, 7, 6},
                        std::array{0, 2, 6, 4}, std::array{1, 5, 7, 3}}) {
    in.corners.push_back({q[0], q[1], q[2]});
    in.corners.push_back({q[0], q[2], q[3]});
  }
  in.part.assign(12, 0);
  in.part_name = {""};
  return in;
}

/// A drum of radius 1: flank of n quadrangles, lids as fans.
inline FacetInput drum_facets(int n, double height) {
  FacetInput in = grid_facets(n, 1, [=](int i, int j) {
    const double a = 2 * kPi * (i % n) / n;
    return Vec3{std::cos(a), std::sin(a), height * j};
  });
  for (std::int32_t top = 0; top < 2; ++top) {
    std::vector<std::int32_t> ring;
    for (std::int32_t k = 0; k < static_cast<std::int32_t>(in.x.size()); ++k)
      if ((in.x[k].z > 0.5 * height) == (top == 1)) ring.push_back(k);
    std::sort(ring.begin(), ring.end(), [&](std::int32_t a, std::int32_t b) {
      return std::atan2(in.x[a].y, in.x[a].x) < std::atan2(in.x[b].y, in.x[b].x);
    });
    for (std::size_t k = 1; k + 1 < ring.size(); ++k)
      in.corners.push_back(top == 1 ? Corners{ring[0], ring[k], ring[k + 1]} : Corners{ring[0], ring[k + 1], ring[k]});
  }
  in.part.assign(in.corners.size(), 0);
  return in;
}

inline double area_of(const FacetMesh& mesh) {
  double area = 0;
  for (std::int32_t t = 0; t < mesh.n_triangles(); ++t) area += 0.5 * norm(area_normal(mesh, t));
  return area;
}

}  // namespace st::test
