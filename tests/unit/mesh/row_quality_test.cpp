#include "mesh/row_quality.h"

#include <gtest/gtest.h>

#include <vector>

#include "unit/mesh/shapes.h"

namespace st {
namespace {

/// `n` quadrilaterals of length 4 and height 1 beside each other, leaning by `lean`, and a triangle at their end.
SurfaceMesh row_of(int n, double lean = 0) {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  for (int i = 0; i <= n; ++i) {
    points.push_back({4.0 * i, 0, 0});
    points.push_back({4.0 * i + lean, 1, 0});
  }
  for (int i = 0; i < n; ++i) {
    triangles.push_back({{2 * i, 2 * i + 2, 2 * i + 3}});
    triangles.push_back({{2 * i, 2 * i + 3, 2 * i + 1}});
  }
  points.push_back({4.0 * n + 0.9, 0.5, 0});
  triangles.push_back({{2 * n, 2 * n + 2, 2 * n + 1}});
  return shapes::from(points, triangles);
}

RowStats measured(const SurfaceMesh& mesh) {
  return measure_rows(mesh, edges_of(mesh), std::vector<double>(mesh.triangles.size(), 0.9));
}

TEST(RowQuality, counts_quadrilaterals_and_the_triangles_beside_them) {
  const RowStats s = measured(row_of(5));
  EXPECT_EQ(s.n_quads, 5);
  EXPECT_EQ(s.n_good, 5);
  EXPECT_EQ(s.n_others, 1);
  EXPECT_NEAR(s.mean, 0.9, 1e-12);
  EXPECT_NEAR(s.p1, 0.9, 1e-12);
  EXPECT_NEAR(s.growth, std::sqrt(2 / 0.45), 1e-12);
  EXPECT_EQ(s.n_grown, 0);
}

TEST(RowQuality, knows_slanted_ones) {
  EXPECT_EQ(measured(row_of(5, 0.5)).n_good, 5);
  EXPECT_EQ(measured(row_of(5, 0.7)).n_good, 0);  // 55 degrees
}

TEST(RowQuality, counts_no_squares_and_none_across_faces) {
  EXPECT_EQ(measured(shapes::cube(3)).n_quads, 0);
  SurfaceMesh parted = row_of(1);
  parted.triangle_face[1] = 1;
  EXPECT_EQ(measured(parted).n_quads, 0);
  EXPECT_EQ(measured(parted).n_others, 3);
}

TEST(RowQuality, counts_neighbours_that_differ_much) {
  SurfaceMesh mesh = row_of(1);
  mesh.node_xyz.back().x = 4.1;
  const RowStats s = measured(mesh);
  EXPECT_NEAR(s.growth, std::sqrt(2 / 0.05), 1e-12);
  EXPECT_EQ(s.n_grown, 1);
}

TEST(RowQuality, of_nothing_is_zero) {
  const RowStats s = measured({});
  EXPECT_EQ(s.n_quads + s.n_others, 0);
  EXPECT_EQ(s.good_share(), 1);
}

}  // namespace
}  // namespace st
