// A wing of squares, as measured by tests of lifting surfaces.
#pragma once

#include "stages/wing_measure.h"

namespace st::test {

inline constexpr int kChordwise = 20, kSpanwise = 40;  // cells of 0.05 by 0.1

/// A wing of chord 1 and span 4 along y: face 0 above and face 1 below, one apart from the other by 0.1.
inline SurfaceMesh plank() {
  SurfaceMesh mesh;
  for (int side = 0; side < 2; ++side) {
    const auto first = static_cast<NodeId>(mesh.node_xyz.size());
    for (int j = 0; j <= kSpanwise; ++j)
      for (int i = 0; i <= kChordwise; ++i) mesh.node_xyz.push_back({0.05 * i, 0.1 * j, side == 0 ? 0.05 : -0.05});
    const auto node = [&](int i, int j) { return first + j * (kChordwise + 1) + i; };
    for (int j = 0; j < kSpanwise; ++j)
      for (int i = 0; i < kChordwise; ++i)
        for (const Triangle& t : {Triangle{{node(i, j), node(i + 1, j), node(i + 1, j + 1)}},
                                  Triangle{{node(i, j), node(i + 1, j + 1), node(i, j + 1)}}}) {
          mesh.triangles.push_back(t);
          mesh.triangle_face.push_back(side);
        }
  }
  return mesh;
}

/// Stations at each cell's middle, in whatever order.
inline WingRecord record(double asked) {
  WingRecord wing;
  for (int j = kSpanwise - 1; j >= 0; --j) {
    const double y = 0.1 * (j + 0.5);
    wing.stations.push_back({{0, y, 0}, {1, y, 0}, 1, asked});
  }
  wing.edges = {4};
  wing.faces = {0, 1};
  wing.span = 4;
  return wing;
}

}  // namespace st::test
