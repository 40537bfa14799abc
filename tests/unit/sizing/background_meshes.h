// Cells of background meshes whose nodes lie on a grid.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>

#include "sizing/background.h"

namespace st::test {

/// 2 n^2 triangles over (n+1)^2 nodes from `first` on, row by row.
inline void add_square_cells(int n, std::int32_t first, BackgroundMesh& mesh) {
  const auto node = [&](int i, int j) { return first + i + (n + 1) * j; };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      mesh.triangles.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
      mesh.triangles.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
    }
}

/// Six tetrahedra in each of n^3 cubes over (n+1)^3 nodes, layer by layer.
inline void add_cube_cells(int n, BackgroundMesh& mesh) {
  const auto node = [n](int i, int j, int k) { return i + (n + 1) * (j + (n + 1) * k); };
  constexpr int kTets[6][4] = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        for (const auto& tet : kTets) {
          mesh.tets.emplace_back();
          for (std::size_t c = 0; c < 4; ++c)
            mesh.tets.back()[c] = node(i + (tet[c] & 1), j + (tet[c] >> 1 & 1), k + (tet[c] >> 2));
        }
}

/// The unit cube in n^3 cubes of six tetrahedra each.
template <class Length>
BackgroundMesh cube_of_tets(int n, const Length& length) {
  BackgroundMesh mesh;
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        mesh.node_xyz.push_back(Vec3{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)} / n);
        const double h = length(mesh.node_xyz.back());
        mesh.node_size.push_back({h, h, {}});
      }
  add_cube_cells(n, mesh);
  return mesh;
}

/// Each coordinate within [lo, hi].
inline Vec3 random_background_point(std::mt19937& random, double lo, double hi) {
  std::uniform_real_distribution<double> uniform(lo, hi);
  return {uniform(random), uniform(random), uniform(random)};
}

}  // namespace st::test
