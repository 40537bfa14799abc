// Crossings of new triangles with others, new or old.
#include "meshing/hole/hole_crossing.h"

#include <gtest/gtest.h>

#include "mesh/crossing.h"

namespace st::test {
namespace {

/// Triangles in planes x = 0.3, 0.6 (faces 0, 1) that a third one in z = 0 (face 2) cuts, and one far away (face 3).
SurfaceMesh four_triangles(const std::vector<TriangleId>& previous) {
  SurfaceMesh m;
  const auto add = [&](FaceId f, Vec3 a, Vec3 b, Vec3 c) {
    const auto n = static_cast<NodeId>(m.node_xyz.size());
    m.node_xyz.insert(m.node_xyz.end(), {a, b, c});
    m.triangles.push_back({{n, n + 1, n + 2}});
    m.triangle_face.push_back(f);
  };
  add(0, {0.3, 0.1, -1}, {0.3, 0.3, -1}, {0.3, 0.2, 1});
  add(1, {0.6, 0.1, -1}, {0.6, 0.3, -1}, {0.6, 0.2, 1});
  add(2, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  add(3, {9, 9, 9}, {9, 8, 9}, {8, 9, 9});
  m.triangle_previous = previous;
  return m;
}

const std::vector<std::int32_t> kOneShell(4, 0);

TEST(HoleCrossing, finds_a_new_triangle_that_crosses_old_ones) {
  const auto pairs = find_new_crossings(four_triangles({0, 1, kNone, 3}), kOneShell);
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[0].a, 0);
  EXPECT_EQ(pairs[0].b, 2);
  EXPECT_EQ(pairs[1].a, 1);
}

TEST(HoleCrossing, leaves_crossings_of_old_triangles_to_the_check) {
  EXPECT_TRUE(find_new_crossings(four_triangles({0, 1, 2, kNone}), kOneShell).empty());
  EXPECT_EQ(find_new_crossings(four_triangles({kNone, 1, 2, 3}), kOneShell).size(), 1u);
}

TEST(HoleCrossing, leaves_triangles_with_one_common_node_alone) {
  SurfaceMesh m = four_triangles({kNone, 1, kNone, 3});
  EXPECT_EQ(find_new_crossings(m, kOneShell).size(), 2u);
  m.triangles[0].n[2] = m.triangles[2].n[1];
  m.node_xyz[m.triangles[0].n[0]] = {0.3, 0.1, -1};
  m.node_xyz[m.triangles[0].n[1]] = {0.2, 0.3, 1};
  int n_shared = 0;
  ASSERT_TRUE(triangles_cross(m.node_xyz, m.triangles[0], m.triangles[2], n_shared));
  ASSERT_EQ(n_shared, 1);
  for (const TrianglePair& p : find_new_crossings(m, kOneShell)) EXPECT_NE(std::pair(p.a, p.b), std::pair(0, 2));
}

TEST(HoleCrossing, does_not_compare_shells) {
  EXPECT_TRUE(find_new_crossings(four_triangles({0, 1, kNone, 3}), std::vector<std::int32_t>{0, 0, 1, 1}).empty());
}

}  // namespace
}  // namespace st::test
