#include "geometry/shape/flatten.h"

#include <gtest/gtest.h>

#include "unit/geometry/chart_models.h"

namespace st {
namespace {

std::optional<std::vector<Vec2>> flat(const test::ChartPatch& p) {
  return flatten(p.x, p.corners, find_topology(p.x, p.corners));
}

double stretch_of(const test::ChartPatch& p) {
  const auto uv = flat(p);
  return uv ? largest_stretch(p.x, p.corners, *uv) : std::numeric_limits<double>::infinity();
}

TEST(Flatten, keeps_the_shape_of_what_is_flat) {
  const auto plate = test::grid_patch(6, 4, [](double s, double t) {
    return std::pair(Vec3{3 * s, 2 * t + s, 5 * s - 2 * t}, Vec3{0, 0, 1});
  });
  EXPECT_NEAR(stretch_of(plate), 1, 1e-9);
}

TEST(Flatten, keeps_a_plane_with_a_narrow_notch) {
  test::ChartPatch p;  // a disc without a sector of one degree
  constexpr int kSectors = 12;
  p.x.push_back({});
  for (int i = 0; i <= kSectors; ++i) {
    const double a = radians(0.5 + 359.0 * i / kSectors);
    p.x.push_back({std::cos(a), std::sin(a), 0});
  }
  for (std::int32_t i = 0; i < kSectors; ++i) p.corners.push_back({0, i + 1, i + 2});
  const auto uv = flat(p);
  ASSERT_TRUE(uv.has_value());
  EXPECT_NEAR(largest_stretch(p.x, p.corners, *uv), 1, 1e-12);
}

TEST(Flatten, projects_what_is_curved_a_little) { EXPECT_LE(stretch_of(test::sphere_patch(2, 1.4, 0.7, 20)), 2.0); }

TEST(Flatten, unrolls_half_a_cylinder_almost_without_stretch) {
  EXPECT_LE(stretch_of(test::cylinder_patch(1, 2, kPi, 30, 12)), 1.1);
}

TEST(Flatten, lays_a_hemisphere_into_the_plane_without_flips) {
  EXPECT_LE(stretch_of(test::sphere_patch(1, kPi, 0.95 * kPi / 2, 24)), 4.0);
}

TEST(Flatten, leaves_holes_open) {
  test::ChartPatch p = test::sphere_patch(1, 2.6, 1.2, 12);
  std::erase_if(p.corners,
                [](const Corners& c) { return c[0] == 6 * 13 + 6 || c[1] == 6 * 13 + 6 || c[2] == 6 * 13 + 6; });
  p.x[6 * 13 + 6] = p.x.back(), p.normal[6 * 13 + 6] = p.normal.back();
  for (Corners& c : p.corners)
    for (std::int32_t& n : c)
      if (n == static_cast<std::int32_t>(p.x.size()) - 1) n = 6 * 13 + 6;
  p.x.pop_back(), p.normal.pop_back();
  ASSERT_EQ(find_topology(p.x, p.corners).loops.size(), 2u);
  EXPECT_LE(stretch_of(p), kMostStretch);
}

/// A bent disc with a hole like a rhombus, `width` times as wide as long.
test::ChartPatch disc_with_sharp_hole(double width) {
  constexpr int kAround = 48;
  const auto ring = test::grid_patch(kAround, 6, [&](double s, double t) {
    const double a = -2 * kPi * s, c = std::cos(a), hole = std::copysign(width * (1 - std::abs(c)), std::sin(a));
    const double x = (1 + t) * c, y = (1 - t) * hole + 2 * t * std::sin(a);
    return std::pair(Vec3{x, y, -0.1 * (x * x + y * y)}, Vec3{0, 0, 1});
  });
  return test::as_tube(ring, kAround);
}

TEST(Flatten, keeps_whole_what_has_a_narrow_notch) {
  const test::ChartPatch p = disc_with_sharp_hole(0.1), slit = disc_with_sharp_hole(0.01);
  EXPECT_FALSE(flat(p));
  EXPECT_TRUE(flatten_whole(p.x, p.corners, find_topology(p.x, p.corners)));
  EXPECT_FALSE(flatten_whole(slit.x, slit.corners, find_topology(slit.x, slit.corners)));
}

TEST(Flatten, refuses_what_must_be_cut) {
  EXPECT_FALSE(flat(test::as_tube(test::cylinder_patch(1, 6, 2 * kPi, 40, 20), 40))) << "a tube";
  const test::ChartPatch deep = test::grid_patch(40, 20, [](double s, double t) {  // a cup, open at its end
    const double a = 2 * kPi * s, z = 1 - 2 * t * 0.98, r = std::sqrt(std::max(1 - z * z, 0.0));
    const Vec3 n{r * std::cos(a), r * std::sin(a), z};
    return std::pair(n, n);
  });
  EXPECT_FALSE(flat(test::as_tube(deep, 40))) << "nearly a sphere";
  EXPECT_FALSE(
      flatten(std::vector<Vec3>(4), std::vector<Corners>{{0, 1, 2}, {1, 0, 3}, {0, 2, 3}, {2, 1, 3}},
              find_topology(std::vector<Vec3>(4), std::vector<Corners>{{0, 1, 2}, {1, 0, 3}, {0, 2, 3}, {2, 1, 3}})))
      << "closed";
}

TEST(Flatten, gives_the_same_bits_again) {
  const test::ChartPatch p = test::sphere_patch(1, 2.8, 1.4, 16);
  EXPECT_TRUE(flat(p) == flat(p));
}

TEST(LargestStretch, is_the_ratio_of_the_singular_values) {
  const std::vector<Vec3> x{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}};
  const std::vector<Corners> corners{{0, 1, 2}};
  EXPECT_NEAR(largest_stretch(x, corners, std::vector<Vec2>{{0, 0}, {1, 0}, {0, 3}}), 6, 1e-12);
  EXPECT_EQ(largest_stretch(x, corners, std::vector<Vec2>{{0, 0}, {0, 3}, {1, 0}}),
            std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace st
