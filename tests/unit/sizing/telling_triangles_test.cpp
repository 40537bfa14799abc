#include "sizing/telling_triangles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "unit/sizing/background_meshes.h"

namespace st {
namespace {

constexpr double kGrowthSlope = 0.2;

/// The unit square in 2 n^2 triangles.
template <class Length>
BackgroundMesh sized_square(int n, const Length& length) {
  BackgroundMesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      mesh.node_xyz.push_back({static_cast<double>(i) / n, static_cast<double>(j) / n, 0});
      const double h = length(mesh.node_xyz.back());
      mesh.node_size.push_back({h, h, {}});
    }
  test::add_square_cells(n, 0, mesh);
  return mesh;
}

double least_at(const BackgroundMesh& mesh, const std::vector<std::array<std::int32_t, 3>>& triangles, Vec3 x) {
  double least = HUGE_VAL;
  for (const auto& [a, b, c] : triangles)
    least = std::min(least,
                     least_over_triangle(x, {mesh.node_xyz[a], mesh.node_xyz[b], mesh.node_xyz[c]},
                                         {mesh.node_size[a].length, mesh.node_size[b].length, mesh.node_size[c].length},
                                         kGrowthSlope));
  return least;
}

TEST(TellingTriangles, are_few_where_lengths_grow_by_the_slope_and_tell_the_same) {
  const BackgroundMesh mesh = sized_square(40, [](Vec3 p) {
    return 0.01 + kGrowthSlope * distance(p, {0.31, 0.42, 0});
  });
  const auto telling = telling_triangles(mesh, kGrowthSlope);
  EXPECT_LT(telling.size(), mesh.triangles.size() / 10);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-0.5, 1.5);
  for (int i = 0; i < 200; ++i) {
    const Vec3 x{place(random), place(random), place(random)};
    const double all = least_at(mesh, mesh.triangles, x), few = least_at(mesh, telling, x);
    EXPECT_GE(few, all);
    EXPECT_LE(few, 1.005001 * all);
  }
}

TEST(TellingTriangles, are_all_where_lengths_grow_slowly) {
  const BackgroundMesh mesh = sized_square(20, [](Vec3 p) { return 0.05 + 0.02 * p.x; });
  EXPECT_EQ(telling_triangles(mesh, kGrowthSlope), mesh.triangles);
}

}  // namespace
}  // namespace st
