// Walls that keep apart, walls that meet.
#include "geometry/shape/wall_gap.h"

#include <gtest/gtest.h>

#include "geometry/shape/analytic.h"
#include "support/shapes.h"

namespace st {
namespace {

using test::make_model;

/// With corners at these (u,v).
WallTriangle triangle_on(const Surface& s, Vec2 a, Vec2 b, Vec2 c) {
  return {{s.point(a), s.point(b), s.point(c)}, {a, b, c}};
}

/// On the surface of the model's face, turned or moved away.
class Wall {
 public:
  explicit Wall(const std::string& shape, FaceId f = 0) : model_(make_model(shape)), surface_(model_.surface(f)) {}
  const Surface& surface() const { return *surface_; }
  WallTriangle triangle(double u, double v, double length) const {
    return triangle_on(*surface_, {u, v}, {u + length, v}, {u, v + length});
  }

 private:
  Model model_;
  std::unique_ptr<Surface> surface_;
};

constexpr double kMeetingTolerance = 1e-6;

TEST(WallGap, tells_how_much_shorter_chords_of_walls_apart_must_be) {
  // spheres of 10 and 9.99: a chord of length l is off by l^2 / 80
  const Wall outer("thin_ball", 0), inner("thin_ball", 1);
  const double length = 0.2;  // of the angle: chords of 2 to 3, off by 0.05 to 0.1
  const WallTriangle a = outer.triangle(1, 0.2, length);
  const auto foot = inner.surface().exact_foot(a.x[0]);
  ASSERT_TRUE(foot);
  const WallTriangle b = inner.triangle(foot->x - 0.05, foot->y - 0.05, length);
  const auto gap = measure_gap(outer.surface(), a, inner.surface(), b, kMeetingTolerance);
  ASSERT_TRUE(gap);
  EXPECT_TRUE(gap->is_apart);
  EXPECT_GT(gap->factor, 0.1);
  EXPECT_LT(gap->factor, 0.4);
  // chords shorter by the factor are off by half of the gap together
  const auto again = measure_gap(outer.surface(), outer.triangle(1, 0.2, gap->factor * length), inner.surface(),
                                 inner.triangle(foot->x, foot->y, gap->factor * length), kMeetingTolerance);
  ASSERT_TRUE(again);
  EXPECT_TRUE(again->is_apart);
  EXPECT_EQ(again->factor, 0.7) << "nothing is asked for but a little less";
}

TEST(WallGap, says_that_walls_closer_than_the_tolerance_meet) {
  const Wall outer("thin_ball", 0), inner("thin_ball", 1);
  const WallTriangle a = outer.triangle(1, 0.2, 0.2);
  const auto foot = inner.surface().exact_foot(a.x[0]);
  const auto gap = measure_gap(outer.surface(), a, inner.surface(), inner.triangle(foot->x, foot->y, 0.2), 0.02);
  ASSERT_TRUE(gap);
  EXPECT_FALSE(gap->is_apart);
}

TEST(WallGap, says_that_a_ball_and_the_plane_under_it_meet_away_from_the_place_where_they_touch) {
  const AxialSurface ball(SurfaceType::kSphere, {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}}, 10, 0, -1, 1, -1, 1);
  for (const double clearance : {0.0, 0.1}) {
    const PlaneSurface plane({{0, 0, 10 + clearance}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, -9, 9, -9, 9);
    for (const double away : {0.5, 1.0, 2.0}) {
      const WallTriangle a = triangle_on(ball, {0.1 * away, -0.2}, {0.1 * away + 0.3, 0}, {0.1 * away, 0.2});
      const WallTriangle b = triangle_on(plane, {away, -1}, {away + 2, 0}, {away, 1});
      const auto gap = measure_gap(ball, a, plane, b, kMeetingTolerance);
      ASSERT_TRUE(gap);
      EXPECT_EQ(gap->is_apart, clearance > 0) << away;
    }
  }
}

TEST(WallGap, says_that_walls_that_cross_meet) {
  const Wall side("cylinder", 0), top("cylinder", 1);  // they share a circle
  const Surface& s = side.surface();
  const WallTriangle a = triangle_on(s, {1, 29}, {1.2, 29}, {1.1, 31});
  const auto foot = top.surface().exact_foot(a.x[2]);
  ASSERT_TRUE(foot);
  const WallTriangle b =
      triangle_on(top.surface(), {foot->x - 3, foot->y - 3}, {foot->x + 3, foot->y - 3}, {foot->x, foot->y + 3});
  const auto gap = measure_gap(s, a, top.surface(), b, kMeetingTolerance);
  ASSERT_TRUE(gap);
  EXPECT_FALSE(gap->is_apart);
}

}  // namespace
}  // namespace st
