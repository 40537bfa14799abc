#include "geometry/shape/projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/shape/analytic.h"
#include "support/shapes.h"

namespace st {
namespace {

const Frame kFrame{{1, 2, 3}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// The k-th of a sequence of numbers in [0,1] that fills it evenly.
double spread(int k, double step) { return std::fmod(0.5 + k * step, 1.0); }

/// Points in and around a box.
Vec3 point_about(const Box3& box, int k) {
  const Vec3 d = 1.4 * (box.hi - box.lo), c = box.center();
  return c + Vec3{d.x * (spread(k, 0.8191725133961645) - 0.5), d.y * (spread(k, 0.6710436067037893) - 0.5),
                  d.z * (spread(k, 0.5497004779019703) - 0.5)};
}

class ClosestPointOf : public testing::TestWithParam<std::string> {};

TEST_P(ClosestPointOf, is_within_the_bounds_and_no_sample_is_closer) {
  const Model model = test::make_model(GetParam());
  const int n_faces = std::min(model.tables().n_faces(), 3);
  for (FaceId f = 0; f < n_faces; ++f) {
    const auto s = model.surface(f);
    const double du = s->u_max() - s->u_min(), dv = s->v_max() - s->v_min();
    std::vector<Vec3> samples;
    for (int i = 0; i <= 40; ++i)
      for (int j = 0; j <= 40; ++j) samples.push_back(s->point({s->u_min() + du * i / 40, s->v_min() + dv * j / 40}));
    const double size = model.tables().box().diagonal();
    for (int k = 0; k < 25; ++k) {
      const Vec3 target = point_about(model.tables().face_box[f], k);
      const SurfaceFoot foot = closest_point(*s, target);
      EXPECT_TRUE(foot.uv.x >= s->u_min() && foot.uv.x <= s->u_max() && foot.uv.y >= s->v_min() &&
                  foot.uv.y <= s->v_max());
      EXPECT_LE(distance(foot.x, s->point(foot.uv)), 1e-14 * size);
      EXPECT_NEAR(foot.distance, distance(foot.x, target), 1e-14 * size);
      double least = 1e300;
      for (const Vec3& x : samples) least = std::min(least, distance(x, target));
      EXPECT_LE(foot.distance, least + 1e-9 * size) << "face " << f << " point " << k;
    }
  }
}

TEST_P(ClosestPointOf, is_the_same_on_a_grid_that_is_kept) {
  const Model model = test::make_model(GetParam());
  const auto s = model.surface(0);
  SurfaceGrid grid;
  for (int k = 0; k < 25; ++k) {
    const Vec3 target = point_about(model.tables().face_box[0], k);
    const SurfaceFoot once = closest_point(*s, target), kept = closest_point(*s, target, grid);
    EXPECT_EQ(kept.uv, once.uv) << k;
    EXPECT_EQ(kept.distance, once.distance) << k;
  }
  EXPECT_EQ(grid.x.size(), grid.u.size() * grid.v.size());
}

TEST_P(ClosestPointOf, is_where_the_descent_from_beside_it_ends) {
  const Model model = test::make_model(GetParam());
  const auto s = model.surface(0);
  const double du = s->u_max() - s->u_min(), dv = s->v_max() - s->v_min(), size = model.tables().box().diagonal();
  for (int k = 0; k < 25; ++k) {
    const Vec3 target = point_about(model.tables().face_box[0], k);
    const SurfaceFoot foot = closest_point(*s, target);
    const SurfaceFoot again = descend_from(*s, target, foot.uv + Vec2{1e-4 * du, -1e-4 * dv});
    EXPECT_NEAR(again.distance, foot.distance, 1e-9 * size) << k;
    EXPECT_TRUE(again.uv.x >= s->u_min() && again.uv.x <= s->u_max() && again.uv.y >= s->v_min() &&
                again.uv.y <= s->v_max());
  }
}

TEST_P(ClosestPointOf, returns_points_of_the_surface_itself) {
  const Model model = test::make_model(GetParam());
  const auto s = model.surface(0);
  const double du = s->u_max() - s->u_min(), dv = s->v_max() - s->v_min(), size = model.tables().box().diagonal();
  for (int k = 0; k < 25; ++k) {
    const Vec3 x =
        s->point({s->u_min() + du * spread(k, 0.7548776662466927), s->v_min() + dv * spread(k, 0.5698402909980532)});
    EXPECT_LE(closest_point(*s, x).distance, 1e-9 * size) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(, ClosestPointOf,
                         testing::Values("square", "sphere", "cylinder", "cone", "torus", "wave", "rational_wave",
                                         "high_degree_wave", "bezier", "stretched", "kinked", "periodic_tube",
                                         "rational_torus", "tube_window", "revolution", "extrusion", "offset"),
                         [](const auto& info) { return info.param; });

TEST(ExactFoot, is_as_close_as_mathematics_says) {
  const double nan = std::nan("");
  const AxialSurface cylinder(SurfaceType::kCylinder, kFrame, 5, 0, 0, 2 * kPi, 0, 20),
      sphere(SurfaceType::kSphere, kFrame, 5, 0, -kPi, kPi, -2, 2),
      torus(SurfaceType::kTorus, kFrame, 5, 2, 0, 2 * kPi, 0, 2 * kPi),
      cone(SurfaceType::kCone, kFrame, 5, 0.4, 0, 2 * kPi, -30, 30);
  const PlaneSurface plane(kFrame, 0, 1, 0, 1);
  for (int k = 1; k < 200; ++k) {  // 0 is on the axis
    const Vec3 p = point_about({{-9, -8, -7}, {11, 12, 13}}, k), d = p - kFrame.origin;
    const double r = std::hypot(d.x, d.y);
    const auto gap = [&](const Surface& s) {
      const auto uv = s.exact_foot(p);
      return uv ? distance(s.point(*uv), p) : nan;
    };
    EXPECT_NEAR(gap(plane), std::abs(d.z), 1e-13);
    EXPECT_NEAR(gap(cylinder), std::abs(r - 5), 1e-13);
    EXPECT_NEAR(gap(sphere), std::abs(norm(d) - 5), 1e-13);
    EXPECT_NEAR(gap(torus), std::abs(std::hypot(r - 5, d.z) - 2), 1e-13);
    // the nearer of the two rulings in the plane through the axis and p
    const auto ruling = [&](double side) { return std::abs((side * r - 5) * std::cos(0.4) - d.z * std::sin(0.4)); };
    EXPECT_NEAR(gap(cone), std::min(ruling(1), ruling(-1)), 1e-12);
  }
}

TEST(ExactFoot, lies_in_the_turn_of_the_bounds) {
  const AxialSurface turned(SurfaceType::kCylinder, kFrame, 5, 0, 4 * kPi, 6 * kPi, 0, 20);
  for (double u = 4 * kPi + 0.1; u < 6 * kPi; u += 0.3)
    EXPECT_NEAR(turned.exact_foot(turned.point({u, 3}))->x, u, 1e-12);
  EXPECT_FALSE(turned.exact_foot({1, 2, 9}));  // on the axis
}

TEST(ClosestPoint, of_a_curve_is_closer_than_every_sample) {
  for (const char* shape : {"wave", "rational_wave", "drilled_cylinder", "revolution", "kinked", "stretched"}) {
    const Model model = test::make_model(shape);
    const ModelTables& t = model.tables();
    for (EdgeId e = 0; e < t.n_edges(); ++e) {
      if (t.edge_is_degenerate[e]) continue;
      const auto c = model.curve(e);
      for (int k = 0; k < 20; ++k) {
        const Vec3 target = point_about(t.box(), k);
        const CurveFoot foot = closest_point(*c, target);
        EXPECT_TRUE(foot.t >= c->t_min() && foot.t <= c->t_max());
        EXPECT_TRUE(foot.x == c->point(foot.t));
        for (int i = 0; i <= 500; ++i) {
          const double least = distance(c->point(c->t_min() + (c->t_max() - c->t_min()) * i / 500), target);
          EXPECT_LE(foot.distance, least + 1e-9 * t.box().diagonal()) << shape << " edge " << e;
        }
      }
    }
  }
}

TEST(ProjectNear, finds_the_foot_on_a_curve) {
  const EllipseCurve c(kFrame, 5, 2, 0, 2 * kPi);
  for (double t = 0.2; t < 6; t += 0.31) {
    const CurvePoint p = c.evaluate(t);
    const Vec3 side = normalized(cross(p.d1, {0, 0, 1}));
    const auto found = project_near(c, p.x + 0.3 * side + Vec3{0, 0, 0.2}, t + 0.05);
    ASSERT_TRUE(found);
    EXPECT_NEAR(*found, t, 1e-9);
  }
}

TEST(ProjectNear, gives_up_on_a_curve_that_is_a_point) {
  EXPECT_FALSE(project_near(EllipseCurve(kFrame, 0, 0, 0, 1), {0, 0, 0}, 0.5));
}

TEST(PointAbove, lies_along_the_normal_as_the_closest_point_does) {
  int n_found = 0;
  for (const char* shape : {"sphere", "torus", "cone", "cylinder"}) {
    const Model model = test::make_model(shape);
    const auto s = model.surface(0);
    const double size = model.tables().box().diagonal(), aside = 1e-5 * size;
    for (int k = 0; k < 50; ++k) {
      const Vec2 guess{s->u_min() + (s->u_max() - s->u_min()) * (0.2 + 0.6 * spread(k, 0.618)),
                       s->v_min() + (s->v_max() - s->v_min()) * (0.2 + 0.6 * spread(k, 0.414))};
      const Vec3 p = s->point(guess) + 0.01 * size * Vec3{spread(k, 0.3), spread(k, 0.7), spread(k, 0.9)};
      const auto above = point_above(*s, p, guess, aside);
      if (!above) continue;
      ++n_found;
      const SurfaceFoot exact = closest_point(*s, p);
      EXPECT_NEAR(above->distance, exact.distance, aside * 1e-3) << shape;
      EXPECT_NEAR(distance(above->foot, exact.x), 0, 3 * aside) << shape;
      EXPECT_LT(angle_between(above->normal, surface_normal(*s, exact.uv)), 1e-3) << shape;
    }
  }
  EXPECT_GT(n_found, 150) << "of 200";
}

TEST(PointAbove, is_none_beyond_the_bounds_and_at_a_pole) {
  const Model ball = test::make_model("sphere"), plate = test::make_model("square");
  const auto s = ball.surface(0), plane = plate.surface(0);
  EXPECT_FALSE(point_above(*s, s->point({0, s->v_max()}), {0, s->v_max()}, 1e-6));
  EXPECT_FALSE(point_above(*plane, plane->point({plane->u_max(), plane->v_max()}) + Vec3{5, 5, 1},
                           {plane->u_max(), plane->v_max()}, 1e-6));
}

}  // namespace
}  // namespace st
