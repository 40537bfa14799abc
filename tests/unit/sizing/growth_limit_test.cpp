#include "sizing/growth_limit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "unit/sizing/background_meshes.h"
#include "unit/sizing/shock_metric.h"

namespace st {
namespace {

using test::cube_of_tets;
using test::random_background_point;

constexpr double kGrowthSlope = 0.2;

TEST(GrowthLimit, lowers_any_lengths_to_the_slope_and_keeps_the_least) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.01, 1);
  BackgroundMesh mesh = cube_of_tets(6, [&](Vec3) { return uniform(random); });
  const BackgroundMesh before = mesh;
  const auto shorter = [](const LocalSize& a, const LocalSize& b) { return a.length < b.length; };
  EXPECT_GT(limit_growth(kGrowthSlope, mesh), 100);
  EXPECT_EQ(std::min_element(mesh.node_size.begin(), mesh.node_size.end(), shorter)->length,
            std::min_element(before.node_size.begin(), before.node_size.end(), shorter)->length);
  for (std::size_t i = 0; i < mesh.node_size.size(); ++i)
    ASSERT_LE(mesh.node_size[i].length, before.node_size[i].length);
  const auto field = make_background(mesh, kGrowthSlope);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 a = random_background_point(random, -0.2, 1.2), b = a + 0.2 * random_background_point(random, -1, 1);
    ASSERT_LE(field->size(a) - field->size(b), kGrowthSlope * distance(a, b) * (1 + 1e-6));
  }
  EXPECT_EQ(limit_growth(kGrowthSlope, mesh), 0);
}

/// Random lengths across and along; some nodes have one length. `direction` tells where the longer one points.
template <class Direction>
BackgroundMesh stretched_cube(std::mt19937& random, const Direction& direction) {
  std::uniform_real_distribution<double> uniform(0.02, 0.06), aspect(0.5, 10);
  BackgroundMesh mesh = cube_of_tets(5, [&](Vec3) { return uniform(random); });
  for (std::size_t i = 0; i < mesh.node_size.size(); ++i) {
    LocalSize& s = mesh.node_size[i];
    if (const double a = aspect(random); a > 1.2) s = {s.length, a * s.length, direction(mesh.node_xyz[i])};
  }
  return mesh;
}

/// The steepest rise of what is requested along `t`, over the slope.
double steepest_along(const SizeField& field, Vec3 t, std::mt19937& random) {
  double steepest = 0;
  int hint = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 a = random_background_point(random, -0.2, 1.2), b = a + 0.1 * random_background_point(random, -1, 1);
    const double rise = field.local(a, hint).in(t)-field.local(b, hint).in(t);
    steepest = std::max(steepest, rise / (kGrowthSlope * distance(a, b)));
  }
  return steepest;
}

TEST(GrowthLimit, holds_along_the_direction_of_metrics_too) {
  std::mt19937 random(6);
  const Vec3 t = normalized(Vec3{3, 2, 1});
  BackgroundMesh mesh = stretched_cube(random, [&](Vec3) { return t; });
  const BackgroundMesh before = mesh;
  limit_growth(kGrowthSlope, mesh);
  double longest = 1;
  for (std::size_t i = 0; i < mesh.node_size.size(); ++i) {
    ASSERT_LE(mesh.node_size[i].along, before.node_size[i].along);
    ASSERT_GE(mesh.node_size[i].along, mesh.node_size[i].length);
    longest = std::max(longest, mesh.node_size[i].along / mesh.node_size[i].length);
  }
  EXPECT_GT(longest, 3);
  EXPECT_LE(steepest_along(*make_background(mesh, kGrowthSlope), t, random), 1 + 1e-6);
  EXPECT_EQ(limit_growth(kGrowthSlope, mesh), 0);
}

TEST(GrowthLimit, leaves_no_jump_where_the_direction_of_metrics_turns) {
  std::mt19937 random(7);
  const auto around = [](Vec3 x) { return normalized(Vec3{1 + x.y, 1 - x.x, 0}); };
  BackgroundMesh mesh = stretched_cube(random, around);
  limit_growth(kGrowthSlope, mesh);
  EXPECT_LE(steepest_along(*make_background(mesh, kGrowthSlope), around({0.5, 0.5, 0.5}), random), 1.6);
}

TEST(GrowthLimit, holds_in_all_directions_of_metrics_and_leaves_those_that_do_not_grow) {
  BackgroundMesh mesh = cube_of_tets(4, [](Vec3) { return 1; });
  for (std::size_t i = 0; i < mesh.node_xyz.size(); ++i) {  // a plane of short lengths in the middle
    const bool is_middle = std::abs(mesh.node_xyz[i].x - 0.5) < 0.01;
    mesh.node_metric.push_back(test::metric_of_shock({1, 0, 0}, is_middle ? 0.1 : 1, 1));
    mesh.node_size[i] = size_of_metric(mesh.node_metric[i]);
  }
  EXPECT_EQ(limit_metrics(kGrowthSlope, mesh), 4 * 25);
  for (std::size_t i = 0; i < mesh.node_xyz.size(); ++i) {
    const double away = std::abs(mesh.node_xyz[i].x - 0.5);
    EXPECT_NEAR(size_of_metric(mesh.node_metric[i]).length, 0.1 + kGrowthSlope * away, 0.01);
    EXPECT_NEAR(mesh.node_metric[i][1], 1, 1e-6) << "along the plane nothing grows";
  }
  EXPECT_EQ(limit_metrics(kGrowthSlope, mesh), 0);
}

}  // namespace
}  // namespace st
