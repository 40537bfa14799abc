// Patches of surfaces as paraboloids.
#include "sizing/gap_patch.h"

#include <gtest/gtest.h>

#include <cmath>

namespace st {
namespace {

/// 3 x 3 points of a height above the plane z = 0, spaced by 0.1.
template <class Height>
std::array<Vec3, 9> grid(const Height& height) {
  std::array<Vec3, 9> points;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      const double x = 0.1 * (column - 1), y = 0.1 * (row - 1);
      points[3 * row + column] = {x, y, height(x, y)};
    }
  return points;
}

TEST(GapPatch, fits_a_paraboloid_by_itself) {
  const Paraboloid p =
      fit_patch(grid([](double x, double y) { return 0.5 * (2 * x * x - 3 * y * y) + 0.7 * x * y; }), {0, 0, 1});
  EXPECT_NEAR(p.k_ss, 2, 1e-4);
  EXPECT_NEAR(p.k_tt, -3, 1e-4);
  EXPECT_NEAR(p.k_st, 0.7, 1e-4);
  EXPECT_NEAR(p.s_lo, -0.1, 0.01);
  EXPECT_NEAR(p.t_hi, 0.1, 0.01);
  EXPECT_LE(distance(p.point(0.05, -0.05), {0.05, -0.05, 0.5 * (2 * 0.0025 - 3 * 0.0025) - 0.7 * 0.0025}), 1e-6);
}

TEST(GapPatch, sags_as_a_circle_does) {
  Paraboloid p;
  p.s_lo = -0.1, p.s_hi = 0.2, p.k_ss = -1;
  EXPECT_NEAR(p.sagging(), (1 - std::sqrt(1 - 0.04)) - 0.02, 1e-5);
  p.flip();
  EXPECT_NEAR(p.sagging(), 0.0002, 1e-6);
}

TEST(GapPatch, fits_a_plane_and_a_point_without_curvature) {
  const Paraboloid plane = fit_patch(grid([](double, double) { return 0.0; }), {0, 0, 1});
  EXPECT_EQ(plane.k_ss, 0);
  EXPECT_EQ(plane.k_tt, 0);
  std::array<Vec3, 9> same;
  same.fill({1, 2, 3});
  const Paraboloid point = fit_patch(same, {0, 0, 1});
  EXPECT_EQ(point.s_lo, point.s_hi);
  EXPECT_NEAR(norm(point.axis_s), 1, 1e-12);
  EXPECT_NEAR(norm(point.axis_t), 1, 1e-12);
  EXPECT_NEAR(dot(point.axis_s, point.axis_t), 0, 1e-12);
}

TEST(GapPatch, has_the_normal_of_its_paraboloid) {
  const Paraboloid p = fit_patch(grid([](double x, double y) { return x * x + 0.5 * y * y; }), {0, 0, 1});
  const double s = 0.07, t = -0.04, d = 1e-6;
  const Vec3 numeric = normalized(cross(p.point(s + d, t) - p.point(s - d, t), p.point(s, t + d) - p.point(s, t - d)));
  EXPECT_LE(distance(p.normal_at(s, t), numeric), 1e-6);
}

TEST(GapPatch, lies_in_its_box) {
  for (const double k : {-4.0, 0.0, 4.0}) {
    const Paraboloid p =
        fit_patch(grid([&](double x, double y) { return 0.5 * k * (x * x + y * y) + 0.3 * k * x * y; }), {0, 0, 1});
    const Box3 box = p.box();
    for (int i = 0; i <= 10; ++i)
      for (int j = 0; j <= 10; ++j) {
        const Vec3 x = p.point(p.s_lo + 0.1 * i * (p.s_hi - p.s_lo), p.t_lo + 0.1 * j * (p.t_hi - p.t_lo));
        for (const auto axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
          EXPECT_GE(x.*axis, box.lo.*axis - 1e-12);
          EXPECT_LE(x.*axis, box.hi.*axis + 1e-12);
        }
      }
  }
}

TEST(GapPatch, is_met_by_a_ray_from_the_side_its_normal_looks_to) {
  const auto bowl = [](double x, double y) { return 0.5 * (x * x + y * y); };
  const Paraboloid p = fit_patch(grid(bowl), {0, 0, 1});
  const auto down = p.facing_distance({0.05, 0.02, 1}, {0, 0, -1});
  ASSERT_TRUE(down);
  EXPECT_NEAR(*down, 1 - bowl(0.05, 0.02), 1e-6);
  EXPECT_FALSE(p.facing_distance({0.05, 0.02, -1}, {0, 0, 1})) << "from behind";
  EXPECT_FALSE(p.facing_distance({0.5, 0, 1}, {0, 0, -1})) << "beside it";
  const double a = radians(50);
  EXPECT_FALSE(p.facing_distance(p.x + Vec3{std::sin(a), 0, std::cos(a)}, {-std::sin(a), 0, -std::cos(a)}))
      << "a V of 50 degrees off the normal";
}

TEST(GapPatch, is_met_from_the_other_side_once_flipped) {
  Paraboloid p = fit_patch(grid([](double x, double y) { return x * x + y * y; }), {0, 0, 1});
  const Vec3 before = p.point(0.05, 0.05);
  p.flip();
  EXPECT_LE(distance(p.point(0.05, 0.05), before), 1e-12) << "the same surface";
  EXPECT_TRUE(p.facing_distance({0, 0, -1}, {0, 0, 1}));
  EXPECT_FALSE(p.facing_distance({0, 0, 1}, {0, 0, -1}));
}

TEST(GapPatch, is_not_met_where_its_cells_lie_outside_the_loops) {
  Paraboloid p = fit_patch(grid([](double, double) { return 0.0; }), {0, 0, 1});
  p.inside = ~(std::uint64_t{0xc0c0} << (8 * 3));  // rows 3 and 4, columns 6 and 7: beside the middle of s = s_hi
  const auto is_inside = [&](double s, double t) { return p.is_inside(s, s, t, t); };
  EXPECT_FALSE(is_inside(0.09, 0.01) || is_inside(0.09, -0.01));
  EXPECT_TRUE(is_inside(-0.09, 0) && is_inside(0.09, 0.09) && is_inside(0.09, -0.09) && is_inside(0, 0));
  EXPECT_FALSE(p.is_inside(0.06, 0.1, -0.01, 0.01));
  EXPECT_TRUE(p.is_inside(0.04, 0.1, -0.01, 0.01) && p.is_inside(0.06, 0.1, -0.04, 0.01)) << "some of it is";
  EXPECT_FALSE(p.facing_distance({0.09, 0, 1}, {0, 0, -1}));
  EXPECT_TRUE(p.facing_distance({-0.09, 0, 1}, {0, 0, -1}));
}

}  // namespace
}  // namespace st
