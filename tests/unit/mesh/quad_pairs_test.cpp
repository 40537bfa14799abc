// Pairs of triangles as quadrilaterals.
#include "mesh/quad_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "unit/mesh/shapes.h"

namespace st {
namespace {

/// A sheet of n x m rectangles of dx by dy, each cut in two; diagonals lean both ways.
SurfaceMesh sheet(int n, int m, double dx, double dy) {
  SurfaceMesh s;
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= n; ++i) s.node_xyz.push_back({i * dx, j * dy, 0});
  const auto node = [n](int i, int j) { return static_cast<NodeId>(j * (n + 1) + i); };
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      const NodeId a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
      if ((i + j) % 2)
        s.triangles.insert(s.triangles.end(), {{{a, b, c}}, {{a, c, d}}});
      else
        s.triangles.insert(s.triangles.end(), {{{a, b, d}}, {{b, c, d}}});
    }
  s.triangle_face.assign(s.triangles.size(), 0);
  s.triangle_group.assign(s.triangles.size(), 0);
  return s;
}

Vec3 area_of(const SurfaceMesh& m, std::span<const NodeId> nodes) {
  Vec3 area;
  for (std::size_t k = 2; k < nodes.size(); ++k)
    area = area +
           0.5 * cross(m.node_xyz[nodes[k - 1]] - m.node_xyz[nodes[0]], m.node_xyz[nodes[k]] - m.node_xyz[nodes[0]]);
  return area;
}

/// Every triangle once, and each quadrilateral covers its two.
void expect_partition(const SurfaceMesh& m, const QuadPairs& pairs) {
  EXPECT_EQ(pairs.triangles.size() + 2 * pairs.quads.size(), m.triangles.size());
  Vec3 whole, sum;
  for (const Triangle& t : m.triangles) whole = whole + area_of(m, t.n);
  for (const TriangleId t : pairs.triangles) sum = sum + area_of(m, m.triangles[t].n);
  for (const Quadrilateral& q : pairs.quads) {
    EXPECT_EQ(std::set<NodeId>(q.n.begin(), q.n.end()).size(), 4u);
    for (const NodeId n : m.triangles[q.triangle].n) EXPECT_NE(std::find(q.n.begin(), q.n.end(), n), q.n.end());
    sum = sum + area_of(m, q.n);
  }
  EXPECT_NEAR(distance(whole, sum), 0, 1e-12 * (1 + norm(whole)));
  EXPECT_TRUE(std::is_sorted(pairs.triangles.begin(), pairs.triangles.end()));
}

TEST(QuadPairs, rows_of_long_rectangles_are_all_quadrilaterals) {
  const SurfaceMesh m = sheet(6, 5, 4, 1);
  const QuadPairs pairs = pair_triangles(m);
  EXPECT_EQ(pairs.quads.size(), 30u);
  EXPECT_TRUE(pairs.triangles.empty());
  expect_partition(m, pairs);
  for (const Quadrilateral& q : pairs.quads) {
    EXPECT_GT(area_of(m, q.n).z, 0);
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 a = m.node_xyz[q.n[(k + 1) % 4]] - m.node_xyz[q.n[k]],
                 b = m.node_xyz[q.n[(k + 2) % 4]] - m.node_xyz[q.n[(k + 1) % 4]];
      EXPECT_NEAR(dot(a, b), 0, 1e-12);
    }
  }
}

TEST(QuadPairs, squares_and_equilateral_triangles_stay_triangles) {
  EXPECT_TRUE(pair_triangles(sheet(6, 5, 1, 1)).quads.empty());
  SurfaceMesh m = sheet(6, 5, 1, std::sqrt(0.75));
  for (Vec3& x : m.node_xyz) x.x += x.y / std::sqrt(3);
  EXPECT_TRUE(pair_triangles(m).quads.empty());
}

TEST(QuadPairs, none_crosses_an_edge_of_a_face_or_folds_over_one) {
  SurfaceMesh m = sheet(1, 1, 4, 1);
  EXPECT_EQ(pair_triangles(m).quads.size(), 1u);
  m.triangle_face[1] = 1;
  EXPECT_TRUE(pair_triangles(m).quads.empty());
  m.triangle_face[1] = 0;
  m.node_xyz[3].z = 1;  // turns one triangle by 45 degrees
  EXPECT_TRUE(pair_triangles(m).quads.empty());
  m = sheet(1, 1, 4, 1);
  std::swap(m.triangles[1].n[0], m.triangles[1].n[1]);  // not oriented alike
  EXPECT_TRUE(pair_triangles(m).quads.empty());
}

TEST(QuadPairs, of_two_possible_partners_the_squarer_one_wins) {
  SurfaceMesh m;  // b shares long sides with a (a parallelogram) and with c (a rectangle)
  m.node_xyz = {{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {0, 1, 0}, {4.5, 2, 0}};
  m.triangles = {{{2, 4, 3}}, {{0, 2, 3}}, {{0, 1, 2}}};
  m.triangle_face.assign(3, 0);
  m.triangle_group.assign(3, 0);
  const QuadPairs pairs = pair_triangles(m);
  ASSERT_EQ(pairs.quads.size(), 1u);
  EXPECT_EQ(pairs.triangles, (std::vector<TriangleId>{0}));
  EXPECT_EQ(pairs.quads[0].triangle, 1);
}

TEST(QuadPairs, any_mesh_is_covered_once) {
  for (const SurfaceMesh& m : {shapes::cube(3), sheet(7, 3, 1.6, 1)}) expect_partition(m, pair_triangles(m));
  const QuadPairs none = all_triangles(sheet(2, 2, 4, 1));
  EXPECT_EQ(none.triangles.size(), 8u);
  EXPECT_TRUE(none.quads.empty());
}

}  // namespace
}  // namespace st
