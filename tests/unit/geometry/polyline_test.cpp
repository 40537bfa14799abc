#include "geometry/shape/polyline.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/shape/projection.h"

namespace st {
namespace {

std::vector<Vec3> circle_points(double radius, int n) {
  std::vector<Vec3> points;
  for (int i = 0; i <= n; ++i) points.push_back({radius * std::cos(3.0 * i / n), radius * std::sin(3.0 * i / n), 0});
  return points;
}

TEST(PolylineCurve, goes_through_its_points_by_arc_length) {
  const std::vector<Vec3> points = circle_points(2, 10);
  const PolylineCurve curve(points);
  const std::vector<double> t = polyline_parameters(points);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_LE(distance(curve.point(t[i]), points[i]), 1e-14);
  EXPECT_NEAR(arc_length(curve, curve.t_min(), curve.t_max()), t.back(), 1e-12);
  EXPECT_EQ(curve.knots().size(), 9u);
}

TEST(PolylineCurve, has_the_curvature_that_its_turning_means) {
  const PolylineCurve curve(circle_points(2, 60));
  for (double s = 0.05; s < 1; s += 0.1) EXPECT_NEAR(curvature(curve.evaluate(s * curve.t_max())), 0.5, 0.001);
  EXPECT_EQ(curvature(PolylineCurve({{0, 0, 0}, {1, 2, 3}}).evaluate(1)), 0);
}

double turn_per_length(const PolylineCurve& curve, double from, double to) {
  return angle_between(curve.evaluate(from).d1, curve.evaluate(to).d1) / (to - from);
}

TEST(PolylineCurve, turns_evenly_along_segments_of_an_arc) {
  std::vector<Vec3> points;
  for (const double a : {0.0, 0.5, 0.6, 1.0, 1.1, 1.5, 2.0}) points.push_back({2 * std::cos(a), 2 * std::sin(a), 0});
  const PolylineCurve curve(points);
  for (double s = 0; s < 0.95; s += 0.05)
    EXPECT_NEAR(turn_per_length(curve, s * curve.t_max(), (s + 0.05) * curve.t_max()), 0.5, 0.02) << s;
}

TEST(PolylineCurve, turns_evenly_where_an_end_cuts_a_segment_off) {
  std::vector<Vec3> points = circle_points(2, 10);
  points.back() = 0.9 * points[9] + 0.1 * points.back();
  const PolylineCurve curve(points);
  EXPECT_NEAR(turn_per_length(curve, 0.8 * curve.t_max(), 0.9 * curve.t_max()), 0.5, 0.02);
  EXPECT_NEAR(turn_per_length(curve, 0.995 * curve.t_max(), curve.t_max()), 0.5, 0.02);
}

TEST(PolylineCurve, is_straight_where_a_line_ends_at_an_arc) {
  std::vector<Vec3> points{{-6, 2, 0}, {-3, 2, 0}};
  for (const double a : {0.0, 0.4, 0.8, 1.2}) points.push_back({2 * std::sin(a), 2 * std::cos(a), 0});
  const PolylineCurve curve(points);
  EXPECT_NEAR(turn_per_length(curve, 0, 5.999), 0, 0.01);
  EXPECT_NEAR(turn_per_length(curve, 6.001, curve.t_max()), 0.5, 0.02);
}

TEST(PolylineCurve, has_feet_near_a_guess) {
  const PolylineCurve curve(circle_points(2, 12));
  for (double s = 0.1; s < 1; s += 0.1) {
    const Vec3 x = curve.point(s * curve.t_max());
    const auto foot = project_near(curve, {x.x, x.y, 0.3}, (s - 0.1) * curve.t_max());
    ASSERT_TRUE(foot);
    EXPECT_NEAR(*foot, s * curve.t_max(), 1e-12);
    EXPECT_NEAR(*project_near(curve, {x.x, x.y, 0.3}, curve.t_max()), s * curve.t_max(), 1e-12);
  }
}

TEST(PolylineCurve, has_places_where_a_segment_is_lost_in_rounding) {
  const Vec3 middle{1, 0, 0}, beside{1, 1e-20, 0}, last{2, 0, 0};
  for (const auto& points : {std::vector{Vec3{}, middle, beside, last}, std::vector{middle, beside}}) {
    const PolylineCurve curve(points);
    for (const double t : polyline_parameters(points)) {
      EXPECT_LE(distance(curve.point(t), points.front()), 2);
      EXPECT_TRUE(std::isfinite(norm(curve.evaluate(t).d2)));
      EXPECT_TRUE(std::isfinite(*project_near(curve, middle, t)));
    }
  }
}

TEST(PolylineCurve2d, has_places_where_a_segment_has_no_parameters) {
  const PolylineCurve2d curve({0, 1, 1, 2}, {{0, 0}, {1, 0}, {1, 1}, {2, 1}});
  for (const double t : {0.0, 1.0, 2.0}) EXPECT_TRUE(std::isfinite(norm(curve.point(t))));
  EXPECT_TRUE(std::isfinite(norm(PolylineCurve2d({0, 0}, {{0, 0}, {1, 0}}).point(0))));
}

TEST(PolylineCurve2d, is_linear_between_its_points) {
  const PolylineCurve2d curve({0, 1, 3}, {{0, 0}, {1, 0}, {1, 4}});
  EXPECT_EQ(curve.point(0.5), (Vec2{0.5, 0}));
  EXPECT_EQ(curve.point(2), (Vec2{1, 2}));
  EXPECT_EQ(curve.point(3), (Vec2{1, 4}));
}

}  // namespace
}  // namespace st
