#include "mesh/row_quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
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

/// Rows of quadrilaterals of length 1 with these heights and `n` columns. The topmost row has `n_last` and leans.
void add_rows(SurfaceMesh& mesh, std::span<const double> heights, int n, int n_last, double lean = 0) {
  double y = 0;
  for (std::size_t row = 0; row <= heights.size(); ++row) {
    for (int i = 0; i <= n; ++i) mesh.node_xyz.push_back({i + (row < heights.size() ? 0 : lean), y, 0});
    if (row < heights.size()) y += heights[row];
  }
  for (int row = 0; row < static_cast<int>(heights.size()); ++row)
    for (int i = 0; i < (row + 1 == static_cast<int>(heights.size()) ? n_last : n); ++i) {
      const int a = row * (n + 1) + i, b = a + n + 1;
      mesh.triangles.push_back({{a, a + 1, b + 1}});
      mesh.triangles.push_back({{a, b + 1, b}});
    }
}

/// Two rows longer than twice their height, and above them one of `height`.
SurfaceMesh two_rows_and(double height, double lean, int n_last = 4) {
  SurfaceMesh mesh;
  const std::vector<double> heights{0.3, 0.4, height};
  add_rows(mesh, heights, 4, n_last, lean);
  return shapes::from(mesh.node_xyz, mesh.triangles);
}

TEST(RowQuality, follows_rows_that_grow_to_squares_up_to_equilateral_triangles) {
  SurfaceMesh grown;
  const std::vector<double> heights{0.2, 0.3, 0.45, 0.7, 1};
  add_rows(grown, heights, 8, 8);
  const int top = 5 * 9, beyond = grown.n_nodes();
  for (int i = 0; i < 8; ++i) grown.node_xyz.push_back({i + 0.5, 2.65 + std::sqrt(0.75), 0});
  for (int i = 0; i < 8; ++i) {
    grown.triangles.push_back({{top + i, top + i + 1, beyond + i}});
    if (i < 7) grown.triangles.push_back({{top + i + 1, beyond + i + 1, beyond + i}});
  }
  const SurfaceMesh mesh = shapes::from(grown.node_xyz, grown.triangles);
  std::vector<double> quality(mesh.triangles.size(), 0.866);
  std::fill(quality.end() - 15, quality.end(), 1.0);
  const RowStats s = measure_rows(mesh, edges_of(mesh), quality);
  EXPECT_EQ(s.n_quads, 24);
  EXPECT_EQ(s.n_continued, 16);
  EXPECT_EQ(s.n_others, 15);
  EXPECT_NEAR(s.mean, 1, 1e-12);
}

TEST(RowQuality, ends_rows_at_tall_oblique_and_loose_quadrilaterals) {
  EXPECT_EQ(measured(two_rows_and(0.8, 0)).n_continued, 4);
  EXPECT_EQ(measured(two_rows_and(1.4, 0)).n_continued, 4);
  EXPECT_EQ(measured(two_rows_and(1.5, 0)).n_continued, 0);
  EXPECT_EQ(measured(two_rows_and(0.8, 0.28)).n_continued, 4);
  EXPECT_EQ(measured(two_rows_and(0.8, 0.3)).n_continued, 0);  // 69.4 degrees
  EXPECT_EQ(measured(two_rows_and(0.8, 0, 2)).n_continued, 2);
  EXPECT_EQ(measured(two_rows_and(0.8, 0, 1)).n_continued, 0);
}

TEST(RowQuality, ends_rows_where_the_face_does) {
  SurfaceMesh mesh = two_rows_and(0.8, 0);
  std::fill(mesh.triangle_face.end() - 8, mesh.triangle_face.end(), 1);
  EXPECT_EQ(measured(mesh).n_continued, 0);
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
