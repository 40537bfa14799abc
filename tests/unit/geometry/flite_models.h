// FLITE files for tests: a box, and text to damage.
#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "geometry/flite/flite_file.h"
#include "unit/io/temporary_directory.h"

namespace st::test {

inline std::vector<Vec3> on_line(Vec3 a, Vec3 b, int n) {
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i) points.push_back(a + (double(i) / (n - 1)) * (b - a));
  return points;
}

/// The unit box: corner k is at (k & 1, k >> 1 & 1, k >> 2); six grids of n x m points, twelve curves, the segments of
/// each region in no order, every second curve from end to start.
inline FliteFile box_file(int n = 3, int m = 4) {
  FliteFile file;
  const auto corner = [](int k) { return Vec3{double(k & 1), double(k >> 1 & 1), double(k >> 2 & 1)}; };
  std::vector<std::pair<int, int>> ends;
  for (int a = 0; a < 8; ++a)
    for (const int bit : {1, 2, 4})
      if (!(a & bit)) {
        const int id = static_cast<int>(ends.size()) + 1;
        const bool is_backward = id % 2 == 0;
        file.curves.push_back(
            {id, 0, on_line(corner(is_backward ? a | bit : a), corner(is_backward ? a : a | bit), 4)});
        file.segments.push_back({id, 0, id - 1});
        ends.emplace_back(a, a | bit);
      }
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      const int id = 2 * axis + side + 1, base = side << axis, u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3;
      FliteSurface surface{id, 0, n, m, {}};
      for (int j = 0; j < m; ++j)
        for (const Vec3 p : on_line(corner(base), corner(base | u), n))
          surface.points.push_back(p + (double(j) / (m - 1)) * (corner(base | v) - corner(base)));
      file.surfaces.push_back(surface);
      FliteRegion region{id, 0, id - 1, {}};
      for (int e = 0; e < 12; ++e)
        if ((ends[e].first >> axis & 1) == side && (ends[e].second >> axis & 1) == side) region.segments.push_back(e);
      std::swap(region.segments[0], region.segments[2]);
      file.regions.push_back(region);
    }
  return file;
}

inline std::string write_text(const TemporaryDirectory& dir, const std::string& text,
                              const std::string& name = "model.dat") {
  std::ofstream(dir / name, std::ios::binary) << text;
  return dir / name;
}

}  // namespace st::test
