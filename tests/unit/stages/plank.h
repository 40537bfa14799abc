// A wing of squares, as measured by tests of lifting surfaces.
#pragma once

#include <vector>

#include "stages/wing_measure.h"

namespace st::test {

inline constexpr int kChordwise = 20, kSpanwise = 40;  // cells of 0.05 by 0.1

/// A wing of chord 1 and span 4 along y: face 0 above and face 1 below, one apart from the other by 0.1. Lines along
/// the span at x, and columns that leave the chord by `sweep` of it.
inline SurfaceMesh plank_of(const std::vector<double>& x, int n_span, double sweep) {
  SurfaceMesh mesh;
  const int n_chord = static_cast<int>(x.size()) - 1;
  for (int side = 0; side < 2; ++side) {
    const auto first = static_cast<NodeId>(mesh.node_xyz.size());
    for (int j = 0; j <= n_span; ++j)
      for (const double own : x)
        mesh.node_xyz.push_back({own, 4.0 * j / n_span + sweep * own, side == 0 ? 0.05 : -0.05});
    const auto node = [&](int i, int j) { return first + j * (n_chord + 1) + i; };
    for (int j = 0; j < n_span; ++j)
      for (int i = 0; i < n_chord; ++i)
        for (const Triangle& t : {Triangle{{node(i, j), node(i + 1, j), node(i + 1, j + 1)}},
                                  Triangle{{node(i, j), node(i + 1, j + 1), node(i, j + 1)}}}) {
          mesh.triangles.push_back(t);
          mesh.triangle_face.push_back(side);
        }
  }
  return mesh;
}

/// Of equal cells.
inline SurfaceMesh plank() {
  std::vector<double> x;
  for (int i = 0; i <= kChordwise; ++i) x.push_back(0.05 * i);
  return plank_of(x, kSpanwise, 0);
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
