#include "sizing/octree_tets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>

#include "unit/sizing/cases.h"

namespace st {
namespace {

double volume(const OctreeTets& m, const std::array<std::int32_t, 4>& t) {
  const auto& x = m.node_xyz;
  return dot(cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]), x[t[3]] - x[t[0]]) / 6;
}

TEST(OctreeTets, fill_the_cube_without_overlap_and_conform) {
  const RasterOctree raster = build_octree(test::kUnitBox, test::sphere_boxes(300));
  const OctreeTets m = octree_tets(raster.shape.view());
  double total = 0;
  std::map<std::array<std::int32_t, 3>, int> sides;
  for (const auto& t : m.tets) {
    const double v = volume(m, t);
    ASSERT_GT(v, 0);
    total += v;
    for (int k = 0; k < 4; ++k) {
      std::array<std::int32_t, 3> s{t[(k + 1) % 4], t[(k + 2) % 4], t[(k + 3) % 4]};
      std::sort(s.begin(), s.end());
      ++sides[s];
    }
  }
  const double edge = raster.shape.edge;
  EXPECT_NEAR(total, edge * edge * edge, 1e-9);
  double border = 0;
  for (const auto& [s, n] : sides) {
    ASSERT_LE(n, 2);
    if (n == 1) border += 0.5 * norm(cross(m.node_xyz[s[1]] - m.node_xyz[s[0]], m.node_xyz[s[2]] - m.node_xyz[s[0]]));
  }
  EXPECT_NEAR(border, 6 * edge * edge, 1e-9);  // only the cube's own sides are used once
}

TEST(OctreeTets, of_a_single_leaf_are_twelve) {
  EXPECT_EQ(octree_tets(build_octree(test::kUnitBox, {}).shape.view()).tets.size(), 12u);
}

}  // namespace
}  // namespace st
