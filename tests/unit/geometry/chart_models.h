// Triangulated patches for tests of charts.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/shape/chart_surface.h"
#include "geometry/shape/flatten.h"

namespace st::test {

struct ChartPatch {
  std::vector<Vec3> x, normal;
  std::vector<Corners> corners;
};

/// A grid of n_u x n_v quadrangles, each two triangles; `point(s, t)` for s and t in [0, 1] gives place and normal.
template <class Point>
ChartPatch grid_patch(int n_u, int n_v, const Point& point) {
  ChartPatch patch;
  for (int j = 0; j <= n_v; ++j)
    for (int i = 0; i <= n_u; ++i) {
      const auto [x, normal] = point(static_cast<double>(i) / n_u, static_cast<double>(j) / n_v);
      patch.x.push_back(x);
      patch.normal.push_back(normalized(normal));
    }
  const auto node = [&](int i, int j) { return j * (n_u + 1) + i; };
  for (int j = 0; j < n_v; ++j)
    for (int i = 0; i < n_u; ++i) {
      patch.corners.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
      patch.corners.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  return patch;
}

/// A part of a sphere around the origin, from the equator up to `latitude`, `longitude` wide (radians).
inline ChartPatch sphere_patch(double radius, double longitude, double latitude, int n) {
  return grid_patch(n, n, [=](double s, double t) {
    const double a = longitude * (s - 0.5), b = latitude * t;
    const Vec3 normal{std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b)};
    return std::pair(radius * normal, normal);
  });
}

/// A cylinder around z, `angle` wide (radians): at 2 pi its two ends in one place.
inline ChartPatch cylinder_patch(double radius, double height, double angle, int n_u, int n_v) {
  return grid_patch(n_u, n_v, [=](double s, double t) {
    const Vec3 normal{std::cos(angle * s), std::sin(angle * s), 0};
    return std::pair(radius * normal + Vec3{0, 0, height * t}, normal);
  });
}

/// The ends of a grid patch in u joined: its last column is its first one.
inline ChartPatch as_tube(const ChartPatch& patch, int n_u) {
  ChartPatch tube = patch;
  for (Corners& c : tube.corners)
    for (std::int32_t& n : c) n = n / (n_u + 1) * n_u + n % (n_u + 1) % n_u;
  tube.x.clear(), tube.normal.clear();
  for (std::size_t n = 0; n < patch.x.size(); ++n) {
    if (static_cast<int>(n) % (n_u + 1) == n_u) continue;
    tube.x.push_back(patch.x[n]);
    tube.normal.push_back(patch.normal[n]);
  }
  return tube;
}

/// Nodes moved to all sides, by up to `most`; the same ones each time.
inline ChartPatch with_noise(ChartPatch patch, double most) {
  std::uint32_t state = 1;
  const auto next = [&] {
    state = 1664525u * state + 1013904223u;
    return most * (static_cast<double>(state >> 8) / (1 << 23) - 1);
  };
  for (Vec3& x : patch.x) x += Vec3{next(), next(), next()};
  return patch;
}

/// With its parameters. Precondition: flatten() gives them.
inline Chart flat_chart(const ChartPatch& patch) {
  return {patch.x, patch.normal, flatten(patch.x, patch.corners, find_topology(patch.x, patch.corners)).value(),
          patch.corners};
}

}  // namespace st::test
