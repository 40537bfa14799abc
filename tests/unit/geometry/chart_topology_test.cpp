#include "geometry/shape/chart_topology.h"

#include <gtest/gtest.h>

#include "geometry/shape/known_neighbours.h"
#include "unit/geometry/chart_models.h"

namespace st {
namespace {

TEST(PatchTopology, of_a_disc_has_one_loop_and_no_genus) {
  const test::ChartPatch p = test::sphere_patch(1, 1, 1, 4);
  const PatchTopology t = find_topology(p.x, p.corners);
  EXPECT_EQ(t.n_components, 1);
  EXPECT_EQ(t.genus, 0);
  EXPECT_TRUE(t.is_manifold);
  ASSERT_EQ(t.loops.size(), 1u);
  EXPECT_EQ(t.loops[0].size(), 16u);
}

TEST(PatchTopology, of_a_tube_has_two_loops_of_its_circumference) {
  const test::ChartPatch p = test::as_tube(test::cylinder_patch(1, 2, 2 * kPi, 60, 3), 60);
  const PatchTopology t = find_topology(p.x, p.corners);
  EXPECT_EQ(t.genus, 0);
  ASSERT_EQ(t.loops.size(), 2u);
  for (const double length : t.loop_length) EXPECT_NEAR(length, 2 * kPi, 0.01);
  EXPECT_EQ(t.outer_loop(), t.loop_length[0] >= t.loop_length[1] ? 0u : 1u);
}

TEST(PatchTopology, of_a_torus_has_genus_one) {
  std::vector<Vec3> x(9);
  std::vector<Corners> corners;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const auto node = [&](int a, int b) { return a % 3 * 3 + b % 3; };
      corners.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
      corners.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  const PatchTopology t = find_topology(x, corners);
  EXPECT_EQ(t.genus, 1);
  EXPECT_TRUE(t.loops.empty());
}

TEST(PatchTopology, sees_fans_that_touch_in_a_node) {
  const std::vector<Vec3> x(5);
  EXPECT_FALSE(find_topology(x, std::vector<Corners>{{0, 1, 2}, {0, 3, 4}}).is_manifold);
}

TEST(PatchNeighbours, are_none_where_a_side_is_used_thrice_or_twice_the_same_way) {
  const auto none = [](const std::vector<Corners>& corners) {
    for (const Corners& n : find_neighbours(corners))
      if (n != Corners{kNone, kNone, kNone}) return false;
    return true;
  };
  EXPECT_TRUE(none({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
  EXPECT_TRUE(none({{0, 1, 2}, {0, 1, 3}}));
  EXPECT_FALSE(none({{0, 1, 2}, {1, 0, 3}}));
}

TEST(PatchFans, are_one_at_a_node_and_two_where_a_line_parts_them) {
  // four triangles around node 4 of a square, then the two sides at it between the left and the right half parted
  const std::vector<Corners> corners{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  std::vector<Corners> neighbours = find_neighbours(corners);
  const std::vector<std::int32_t> whole = find_fans(corners, neighbours);
  EXPECT_EQ(whole, (std::vector<std::int32_t>{0, 1, 2, 1, 3, 2, 3, 4, 2, 4, 0, 2}));
  neighbours[0][1] = neighbours[1][2] = neighbours[2][1] = neighbours[3][2] = kNone;
  const std::vector<std::int32_t> parted = find_fans(corners, neighbours);
  EXPECT_EQ(parted, (std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 4, 6, 5, 7, 0, 2}));
}

}  // namespace
}  // namespace st
