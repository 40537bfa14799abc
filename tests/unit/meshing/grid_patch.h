// A flat square of triangles as a patch.
#pragma once

#include <vector>

#include "mesh/surface_mesh.h"

namespace st::test {

/// n x n unit squares of two triangles each; node (i, j) has number j (n + 1) + i.
inline std::vector<Triangle> grid_triangles(int n) {
  std::vector<Triangle> triangles;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const NodeId a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      triangles.push_back({{a, b, d}});
      triangles.push_back({{a, d, c}});
    }
  return triangles;
}

inline std::vector<Vec3> grid_nodes(int n) {
  std::vector<Vec3> xyz;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) xyz.push_back({1.0 * i, 1.0 * j, 0});
  return xyz;
}

/// All nodes are inside: nothing is fixed.
inline FacePatch grid_patch(int n) {
  FacePatch patch;
  patch.face = 0;
  patch.inner_xyz = grid_nodes(n);
  for (const Vec3 x : patch.inner_xyz) patch.inner_uv.push_back({x.x, x.y});
  patch.inner_size.assign(patch.inner_xyz.size(), 1);
  patch.triangles = grid_triangles(n);
  return patch;
}

}  // namespace st::test
