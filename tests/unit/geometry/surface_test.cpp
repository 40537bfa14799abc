#include "geometry/shape/surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/shape/analytic.h"
#include "geometry/shape/bspline.h"
#include "support/shapes.h"

namespace st {
namespace {

const Frame kFrame{{1, 2, 3}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const AxialSurface kSphere(SurfaceType::kSphere, kFrame, 5, 0, 0, 2 * kPi, -kPi / 2, kPi / 2);
const AxialSurface kCylinder(SurfaceType::kCylinder, kFrame, 5, 0, 0, 2 * kPi, 0, 20);
const AxialSurface kTorus(SurfaceType::kTorus, kFrame, 5, 2, 0, 2 * kPi, 0, 2 * kPi);

TEST(SurfaceNormal, is_radial_on_a_sphere) {
  for (double u = 0; u < 6; u += 0.5)
    for (double v = -1.5; v < 1.6; v += 0.25)
      EXPECT_LE(distance(surface_normal(kSphere, {u, v}), (kSphere.point({u, v}) - kFrame.origin) / 5), 1e-12);
}

TEST(SurfaceNormal, is_the_axis_at_the_poles) {
  for (double u = 0; u < 6; u += 0.5) {
    EXPECT_LE(distance(surface_normal(kSphere, {u, kPi / 2}), {0, 0, 1}), 1e-4);
    EXPECT_LE(distance(surface_normal(kSphere, {u, -kPi / 2}), {0, 0, -1}), 1e-4);
  }
}

TEST(SurfaceNormal, at_an_apex_is_that_of_its_ruling) {
  const double half = 0.4, apex = 5 / std::sin(half);
  const AxialSurface cone(SurfaceType::kCone, kFrame, 5, -half, 0, 2 * kPi, 0, apex);
  const Vec3 n = surface_normal(cone, {1, apex});
  EXPECT_NEAR(norm(n), 1, 1e-12);
  EXPECT_LE(distance(n, surface_normal(cone, {1, 0.5 * apex})), 1e-3);
}

TEST(SurfaceNormal, of_a_surface_without_extent_is_zero) {
  const AxialSurface needle(SurfaceType::kCylinder, kFrame, 0, 0, 0, 6, 0, 1);
  EXPECT_EQ(norm(surface_normal(needle, {1, 0.5})), 0);
}

TEST(PrincipalCurvature, of_a_sphere_is_one_over_r_both_ways) {
  const Curvature c = principal_curvature(kSphere.evaluate2({1, 0.3}));
  EXPECT_NEAR(c.k1, -0.2, 1e-9);
  EXPECT_NEAR(c.k2, -0.2, 1e-9);
}

TEST(PrincipalCurvature, of_a_cylinder_is_one_over_r_and_none) {
  const Curvature c = principal_curvature(kCylinder.evaluate2({1, 0.3}));
  EXPECT_NEAR(std::abs(c.k1), 0.2, 1e-12);
  EXPECT_NEAR(c.k2, 0, 1e-12);
}

TEST(PrincipalCurvature, of_a_torus_changes_sign_inside) {
  const Curvature out = principal_curvature(kTorus.evaluate2({2, 0})),
                  in = principal_curvature(kTorus.evaluate2({2, kPi}));
  EXPECT_NEAR(std::abs(out.k1), 1.0 / 2, 1e-12);
  EXPECT_NEAR(std::abs(out.k2), 1.0 / 7, 1e-12);
  EXPECT_GT(out.k1 * out.k2, 0);
  EXPECT_NEAR(std::abs(in.k1), 1.0 / 2, 1e-12);
  EXPECT_NEAR(std::abs(in.k2), 1.0 / 3, 1e-12);
  EXPECT_LT(in.k1 * in.k2, 0);
}

TEST(PrincipalCurvature, does_not_depend_on_the_parametrisation) {
  SurfacePoint2 p = kTorus.evaluate2({2, 1});
  const Curvature before = principal_curvature(p);
  // u' = u/1000, v' = v + 3u
  const SurfacePoint2 q{
      p.x, 1000 * (p.du - 3 * p.dv), p.dv, 1e6 * (p.duu - 6 * p.duv + 9 * p.dvv), 1000 * (p.duv - 3 * p.dvv), p.dvv};
  const Curvature after = principal_curvature(q);
  EXPECT_NEAR(before.k1, after.k1, 1e-10);
  EXPECT_NEAR(before.k2, after.k2, 1e-10);
}

TEST(PrincipalCurvature, is_zero_where_the_surface_is_singular) {
  const SurfacePoint2 p = kSphere.evaluate2({1, 0});
  const Curvature c = principal_curvature({p.x, {}, p.dv, p.duu, p.duv, p.dvv});
  EXPECT_EQ(c.k1, 0);
  EXPECT_EQ(c.k2, 0);
}

TEST(TangentStep, leads_to_the_nearest_point_of_the_tangent_plane) {
  const Vec3 du{2, 0, 0}, dv{1, 0.1, 0};  // neither unit nor at right angles
  const auto step = tangent_step(du, dv, 3 * du - 0.5 * dv + Vec3{0, 0, 7});
  ASSERT_TRUE(step);
  EXPECT_NEAR(step->x, 3, 1e-12);
  EXPECT_NEAR(step->y, -0.5, 1e-12);
}

TEST(TangentStep, there_is_none_without_a_tangent_plane) {
  EXPECT_FALSE(tangent_step({1, 0, 0}, {2, 0, 0}, {1, 1, 0}));
  EXPECT_FALSE(tangent_step({}, {1, 0, 0}, {1, 1, 0}));
  EXPECT_FALSE(tangent_step({1, 0, 0}, {1, 1e-4, 0}, {1, 1, 0}, 1e-6));
  EXPECT_TRUE(tangent_step({1, 0, 0}, {1, 1e-4, 0}, {1, 1, 0}, 1e-10));
}

TEST(ProjectNear, finds_the_foot_of_a_point_off_the_surface) {
  for (const AxialSurface* s : {&kSphere, &kCylinder, &kTorus})
    for (double off : {-0.5, 0.0, 0.5, 2.0}) {
      const Vec2 foot{2.5, 0.7};
      const Vec3 target = s->point(foot) + off * surface_normal(*s, foot);
      const auto found = project_near(*s, target, {2.8, 0.5});
      ASSERT_TRUE(found);
      EXPECT_LE(distance(s->point(*found), s->point(foot)), 1e-9);
    }
}

TEST(ProjectNear, works_on_free_form_surfaces) {
  for (const char* shape : {"wave", "rational_wave", "high_degree_wave", "stretched", "revolution", "offset"}) {
    const Model model = test::make_model(shape);
    const auto s = model.surface(0);
    const double ru = s->u_max() - s->u_min(), rv = s->v_max() - s->v_min();
    for (double a : {0.2, 0.45, 0.8})
      for (double b : {0.15, 0.5, 0.85}) {
        const Vec2 foot{s->u_min() + a * ru, s->v_min() + b * rv};
        const auto found = project_near(*s, s->point(foot) + 0.01 * surface_normal(*s, foot),
                                        {foot.x + 0.004 * ru, foot.y - 0.004 * rv});
        ASSERT_TRUE(found) << shape;
        EXPECT_LE(distance(s->point(*found), s->point(foot)), 1e-8) << shape;
      }
  }
}

TEST(ProjectNear, stays_near_the_bounds) {
  const PlaneSurface plane(kFrame, 0, 10, 0, 4);
  const auto found = project_near(plane, {100, 100, 3}, {5, 2});
  ASSERT_TRUE(found);
  EXPECT_LE(found->x, 10.1 + 1e-12);
  EXPECT_LE(found->y, 4.04 + 1e-12);
  EXPECT_GE(found->x, 10);
}

TEST(ProjectNear, gives_up_where_the_surface_has_no_tangent_plane) {
  const AxialSurface needle(SurfaceType::kCylinder, kFrame, 0, 0, 0, 6, 0, 1);
  EXPECT_FALSE(project_near(needle, {2, 2, 3}, {1, 0.5}));
}

const char* const kManyShapes[] = {"square",         "sphere",        "cylinder",        "cone",   "torus",
                                   "wave",           "rational_wave", "stretched",       "kinked", "periodic_tube",
                                   "revolution",     "extrusion",     "offset",          "bezier", "closed_tube",
                                   "rational_torus", "tube_window",   "high_degree_wave"};

TEST(SingularSides, are_the_poles_of_a_sphere_and_the_apex_of_a_cone) {
  const AxialSurface sphere(SurfaceType::kSphere, kFrame, 5, 0, 0, 2 * kPi, -kPi / 2, kPi / 2);
  const auto poles = singular_sides(sphere, 1e-9);
  ASSERT_EQ(poles.size(), 2u);
  EXPECT_EQ(poles[0].side, 2);
  EXPECT_LE(distance(poles[0].x, {1, 2, -2}), 1e-12);
  EXPECT_EQ(poles[1].side, 3);
  const double apex = 5 / std::sin(0.4);
  const auto tip = singular_sides(AxialSurface(SurfaceType::kCone, kFrame, 5, -0.4, 0, 2 * kPi, 0, apex), 1e-9);
  ASSERT_EQ(tip.size(), 1u);
  EXPECT_EQ(tip[0].side, 3);
  EXPECT_TRUE(singular_sides(kTorus, 1e-9).empty());
  EXPECT_TRUE(singular_sides(kCylinder, 1e-9).empty());
}

TEST(SurfacePeriod, brings_back_the_same_point) {
  for (const char* shape : kManyShapes) {
    const auto model = test::make_model(shape);
    const auto s = model.surface(0);
    const Vec2 uv{0.7 * s->u_min() + 0.3 * s->u_max(), 0.4 * s->v_min() + 0.6 * s->v_max()};
    const double size = model.tables().box().diagonal();
    EXPECT_LE(distance(s->point({uv.x + s->u_period(), uv.y}), s->point(uv)), 1e-12 * size) << shape;
    EXPECT_LE(distance(s->point({uv.x, uv.y + s->v_period()}), s->point(uv)), 1e-12 * size) << shape;
  }
  EXPECT_EQ(kTorus.u_period(), 2 * kPi);
  EXPECT_EQ(kTorus.v_period(), 2 * kPi);
  EXPECT_EQ(kSphere.v_period(), 0);
  const auto tube = test::make_model("periodic_tube");
  EXPECT_GT(tube.surface(0)->u_period() + tube.surface(0)->v_period(), 0);
  const auto revolution = test::make_model("revolution");
  EXPECT_NEAR(revolution.surface(0)->u_period(), 2 * kPi, 1e-15);
}

TEST(EvaluateBatch, is_evaluate_at_each_point) {
  for (const char* shape : kManyShapes) {
    const auto model = test::make_model(shape);
    const auto s = model.surface(0);
    std::vector<Vec2> uv;
    for (const double share : {1.0, 0.37, 0.0})  // rows of one v, in no order of u
      for (int k = 0; k < 40; ++k)
        uv.push_back({s->u_min() + (s->u_max() - s->u_min()) * (k * k % 40) / 39.0,
                      s->v_min() + (s->v_max() - s->v_min()) * (k == 20 ? 0.5 : share)});
    std::vector<SurfacePoint> out(uv.size());
    std::vector<Vec3> x(uv.size());
    s->evaluate_batch(uv, out);
    point_batch(*s, uv, x);
    for (std::size_t k = 0; k < uv.size(); ++k) {
      const SurfacePoint p = s->evaluate(uv[k]);
      EXPECT_TRUE(out[k].x == p.x && out[k].du == p.du && out[k].dv == p.dv) << shape;
      EXPECT_TRUE(x[k] == s->point(uv[k])) << shape;
    }
  }
}

TEST(FlattestDirection, is_the_axis_of_a_cylinder_and_the_generator_of_a_cone) {
  const Model cylinder = test::make_model("cylinder"), cone = test::make_model("cone");
  for (const Model* model : {&cylinder, &cone})
    for (FaceId f = 0; f < model->tables().n_faces(); ++f) {
      const auto surface = model->surface(f);
      if (surface->type() == SurfaceType::kPlane) continue;
      const Vec2 uv{0.3 * surface->u_min() + 0.7 * surface->u_max(), 0.6 * surface->v_min() + 0.4 * surface->v_max()};
      const SurfacePoint2 p = surface->evaluate2(uv);
      const Vec3 t = flattest_direction(p, principal_curvature(p));
      EXPECT_NEAR(norm(t), 1, 1e-12);
      EXPECT_NEAR(std::abs(dot(t, normalized(p.dv))), 1, 1e-9);  // straight lines run along v
    }
}

TEST(FlattestDirection, is_none_on_a_sphere) {
  const Model sphere = test::make_model("sphere");
  const SurfacePoint2 p = sphere.surface(0)->evaluate2({1, 0.3});
  Curvature c = principal_curvature(p);
  c.k2 = c.k1;
  EXPECT_TRUE(flattest_direction(p, c) == Vec3{});
}

}  // namespace
}  // namespace st
