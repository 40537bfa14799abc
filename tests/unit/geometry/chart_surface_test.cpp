#include "geometry/shape/chart_surface.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "geometry/shape/projection.h"
#include "unit/geometry/chart_models.h"

namespace st {
namespace {

constexpr double kRadius = 2;

class ChartOfSphere : public ::testing::Test {
 protected:
  const Chart chart_ = test::flat_chart(test::sphere_patch(kRadius, 2.4, 1.2, 24));
  const ChartSurface surface_{chart_};
  std::mt19937 random_{5};

  /// Inside triangle t, in (u,v) and in space.
  std::pair<Vec2, Vec3> inside(std::size_t t) {
    std::uniform_real_distribution<double> share(0.05, 0.9);
    const double a = share(random_), b = (1 - a) * share(random_), c = 1 - a - b;
    const Corners& n = chart_.corners[t];
    return {a * chart_.uv[n[0]] + b * chart_.uv[n[1]] + c * chart_.uv[n[2]],
            a * chart_.x[n[0]] + b * chart_.x[n[1]] + c * chart_.x[n[2]]};
  }
};

TEST_F(ChartOfSphere, is_on_its_facets) {
  for (std::size_t t = 0; t < chart_.corners.size(); ++t) {
    const auto [uv, x] = inside(t);
    EXPECT_EQ(surface_.locate(uv).triangle, static_cast<std::int32_t>(t));
    EXPECT_LE(distance(surface_.point(uv), x), 1e-13);
  }
}

TEST(ChartSurface, holds_what_is_in_its_patch) {
  const ChartSurface surface(
      {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, std::vector<Vec3>(3, {0, 0, 1}), {{0, 0}, {1, 0}, {0, 1}}, {{0, 1, 2}}});
  for (const Vec2 uv : {Vec2{0.3, 0.3}, Vec2{0.5, 0.5}, Vec2{0, 1}}) EXPECT_TRUE(surface.holds(uv));
  EXPECT_FALSE(surface.holds({0.9, 0.9})) << "within the bounds, beside the patch";
}

TEST_F(ChartOfSphere, has_a_triangle_for_what_is_no_place) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const Vec2 p : {Vec2{none, none}, Vec2{none, 0}, Vec2{1e300, -1e300}})
    EXPECT_LT(static_cast<std::size_t>(surface_.locate(p).triangle), chart_.corners.size());
}

TEST_F(ChartOfSphere, has_the_derivatives_of_differences) {
  const double step = 1e-6;
  for (std::size_t t = 0; t < chart_.corners.size(); t += 7) {
    const auto [uv, x] = inside(t);
    const SurfacePoint p = surface_.evaluate(uv);
    const Vec3 du = (surface_.point({uv.x + step, uv.y}) - surface_.point({uv.x - step, uv.y})) / (2 * step);
    const Vec3 dv = (surface_.point({uv.x, uv.y + step}) - surface_.point({uv.x, uv.y - step})) / (2 * step);
    EXPECT_LE(distance(p.du, du), 1e-8);
    EXPECT_LE(distance(p.dv, dv), 1e-8);
  }
}

TEST_F(ChartOfSphere, has_the_curvature_of_the_sphere) {
  for (std::size_t t = 0; t < chart_.corners.size(); t += 5) {
    const Curvature c = principal_curvature(surface_.evaluate2(inside(t).first));
    EXPECT_NEAR(std::abs(c.k1), 1 / kRadius, 0.02 / kRadius);
    EXPECT_NEAR(std::abs(c.k2), 1 / kRadius, 0.02 / kRadius);
    EXPECT_LT(c.k1, 0) << "bent away from its outward normal";
  }
}

TEST(ChartSurface, has_the_curvature_of_a_cylinder_of_few_facets) {
  const Chart chart = test::flat_chart(test::cylinder_patch(2, 3, radians(150), 5, 2));  // 30 degrees each
  const ChartSurface surface(chart);
  for (const Corners& n : chart.corners)
    for (const double share : {0.0, 0.2, 1.0 / 3}) {
      const Vec2 uv = share * (chart.uv[n[0]] + chart.uv[n[1]]) + (1 - 2 * share) * chart.uv[n[2]];
      const Curvature c = principal_curvature(surface.evaluate2(uv));
      EXPECT_NEAR(c.k1, -1 / 2.0, 0.01);
      EXPECT_NEAR(c.k2, 0, 1e-9);
    }
}

TEST_F(ChartOfSphere, has_feet_on_itself) {
  for (std::size_t t = 0; t < chart_.corners.size(); t += 5) {
    const auto [uv, x] = inside(t);
    const SurfacePoint p = surface_.evaluate(uv);
    const Vec3 above = x + 0.01 * normalized(cross(p.du, p.dv));
    const SurfaceFoot foot = closest_point(surface_, above);
    EXPECT_NEAR(foot.distance, 0.01, 1e-12);
    EXPECT_LE(distance(foot.x, x), 1e-12);
    const Vec2 guess{uv.x + 0.1, uv.y - 0.1};
    ASSERT_TRUE(project_near(surface_, above, guess));
    EXPECT_LE(distance(surface_.point(*project_near(surface_, above, guess)), x), 1e-12);
    EXPECT_LE(distance(descend_from(surface_, above, guess).x, x), 1e-12);
  }
}

TEST_F(ChartOfSphere, stays_at_its_rim_outside) {
  for (const double off : {1e-6, 0.1, 10.0}) {
    const Vec2 outside{surface_.u_max() + off, surface_.v_max() + off};
    const auto place = surface_.locate(outside);
    EXPECT_EQ(*std::min_element(place.weight.begin(), place.weight.end()), 0);
    EXPECT_LE(norm(surface_.point(outside)), kRadius * 1.001);
  }
}

TEST_F(ChartOfSphere, is_the_same_whatever_was_asked_before) {
  const auto copy = surface_.copy();
  const Vec2 corner = chart_.uv[chart_.corners[300][0]];  // several triangles have it
  const SurfacePoint first = surface_.evaluate(corner);
  for (std::size_t t = 0; t < chart_.corners.size(); t += 3) surface_.evaluate(inside(t).first);
  EXPECT_EQ(surface_.evaluate(corner).du, first.du);
  EXPECT_EQ(copy->evaluate(corner).du, first.du);
}

// A wedge of 8 degrees, folded around its edge: flat it is one strip.
TEST(ChartFoot, near_a_guess_stays_on_the_side_of_the_guess) {
  const double slope = std::tan(radians(4));
  const auto wedge = test::grid_patch(40, 4, [&](double s, double t) {
    const double along = 2 * s - 1, bend = std::sqrt(along * along + 1e-6);
    return std::pair(Vec3{1 - bend, t, slope * along}, Vec3{slope, 0, along});
  });
  Chart chart{wedge.x, wedge.normal, {}, wedge.corners};
  for (int j = 0; j <= 4; ++j)
    for (int i = 0; i <= 40; ++i) chart.uv.push_back({i / 20.0, j / 4.0});
  const ChartSurface surface(chart);
  const Vec3 low = surface.point({0.5, 0.4});
  const Vec3 nearer_above{low.x, low.y, 0.2 * slope * 0.5};
  ASSERT_GT(surface.exact_foot(nearer_above)->x, 1) << "the upper side is nearer";
  EXPECT_LT(surface.foot_near(nearer_above, {0.5, 0.4})->x, 1);
}

}  // namespace
}  // namespace st
