#include "geometry/shape/flatten_coarse.h"

#include <gtest/gtest.h>

#include "unit/geometry/chart_models.h"

namespace st {
namespace {

std::optional<std::vector<Vec2>> flat_by_coarse(const test::ChartPatch& p) {
  return flatten_coarse(p.x, p.corners, find_topology(p.x, p.corners));
}

double stretch_by_coarse(const test::ChartPatch& p) {
  const auto uv = flat_by_coarse(p);
  return uv ? largest_stretch(p.x, p.corners, *uv) : std::numeric_limits<double>::infinity();
}

/// A dome that no direction projects: 2.8 radians wide, up to 1.45 radians of latitude.
test::ChartPatch wide_dome(int n) { return test::sphere_patch(1, 2.8, 1.45, n); }

TEST(FlattenCoarse, stretches_little_more_than_solving_for_all_nodes) {
  const test::ChartPatch p = wide_dome(64);
  const auto solved = flatten(p.x, p.corners, find_topology(p.x, p.corners));
  ASSERT_TRUE(solved);
  EXPECT_LE(stretch_by_coarse(p), 1.2 * largest_stretch(p.x, p.corners, *solved));
}

TEST(FlattenCoarse, takes_more_triangles_than_are_solved) { EXPECT_LE(stretch_by_coarse(wide_dome(150)), 4.0); }

TEST(FlattenCoarse, unrolls_half_a_cylinder_almost_without_stretch) {
  // with ripples, which neither a projection nor unrolling takes
  const test::ChartPatch p = test::grid_patch(120, 60, [](double s, double t) {
    const double a = 1.1 * kPi * s, r = 1 + 0.01 * std::sin(20 * a) * std::sin(12 * t);
    return std::pair(Vec3{r * std::cos(a), r * std::sin(a), 2 * t}, Vec3{std::cos(a), std::sin(a), 0});
  });
  EXPECT_LE(stretch_by_coarse(p), 1.25);
}

TEST(FlattenCoarse, takes_the_noise_of_scans) {
  const double spacing = 2.8 / 90;
  EXPECT_LE(stretch_by_coarse(test::with_noise(wide_dome(90), 0.05 * spacing)), kMostStretch);
}

TEST(FlattenCoarse, projects_what_is_flat) {
  const test::ChartPatch plate = test::grid_patch(50, 50, [](double s, double t) {
    return std::pair(Vec3{3 * s, 2 * t + s, 5 * s - 2 * t}, Vec3{0, 0, 1});
  });
  EXPECT_NEAR(stretch_by_coarse(plate), 1, 1e-9);
}

TEST(FlattenCoarse, refuses_what_must_be_cut) {
  EXPECT_FALSE(flat_by_coarse(test::as_tube(test::cylinder_patch(1, 6, 2 * kPi, 80, 60), 80))) << "a tube";
}

TEST(FlattenCoarse, gives_the_same_bits_again) {
  const test::ChartPatch p = wide_dome(64);
  const auto first = flat_by_coarse(p);
  ASSERT_TRUE(first);
  EXPECT_TRUE(first == flat_by_coarse(p));
}

}  // namespace
}  // namespace st
