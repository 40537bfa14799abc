#include "geometry/shape/analytic.h"

#include <gtest/gtest.h>

#include <cmath>

namespace st {
namespace {

const Frame kTilted{{3, -2, 5}, {0.6, 0.8, 0}, {-0.8, 0.6, 0}, {0, 0, 1}};
const Frame kLeftHanded{{3, -2, 5}, {0.6, 0.8, 0}, {0.8, -0.6, 0}, {0, 0, 1}};

double axis_distance(Vec3 x) { return std::hypot(x.x - 3, x.y + 2); }

TEST(AxialSurface, lies_where_its_equation_says) {
  for (const Frame& frame : {kTilted, kLeftHanded})
    for (double u = 0; u < 6.3; u += 0.7)
      for (double v = -1.5; v <= 1.5; v += 0.5) {
        const Vec3 cylinder = AxialSurface(SurfaceType::kCylinder, frame, 4, 0, 0, 6, -2, 2).point({u, v});
        EXPECT_NEAR(axis_distance(cylinder), 4, 1e-14);
        EXPECT_NEAR(cylinder.z, 5 + v, 1e-14);
        const Vec3 cone = AxialSurface(SurfaceType::kCone, frame, 4, 0.3, 0, 6, -2, 2).point({u, v});
        EXPECT_NEAR(axis_distance(cone), 4 + (cone.z - 5) * std::tan(0.3), 1e-14);
        EXPECT_NEAR(distance(AxialSurface(SurfaceType::kSphere, frame, 4, 0, 0, 6, -2, 2).point({u, v}), frame.origin),
                    4, 1e-14);
        const Vec3 torus = AxialSurface(SurfaceType::kTorus, frame, 4, 1.5, 0, 6, -2, 2).point({u, v});
        EXPECT_NEAR(std::hypot(axis_distance(torus) - 4, torus.z - 5), 1.5, 1e-14);
      }
}

TEST(AxialSurface, turns_with_the_hand_of_its_frame) {
  const auto normal = [](const Frame& f) {
    const SurfacePoint p = AxialSurface(SurfaceType::kCylinder, f, 4, 0, 0, 6, -2, 2).evaluate({1, 0.5});
    return dot(cross(p.du, p.dv), p.x - f.origin);
  };
  EXPECT_GT(normal(kTilted), 0);
  EXPECT_LT(normal(kLeftHanded), 0);
}

TEST(AxialSurface, has_apex_and_poles_without_du) {
  const AxialSurface cone(SurfaceType::kCone, kTilted, 4, -0.5, 0, 6, 0, 9);
  const double apex = 4 / std::sin(0.5);
  EXPECT_NEAR(norm(cone.evaluate({1, apex}).du), 0, 1e-14);
  EXPECT_LE(distance(cone.point({1, apex}), cone.point({4, apex})), 1e-14);
  const AxialSurface sphere(SurfaceType::kSphere, kTilted, 4, 0, 0, 6, -2, 2);
  EXPECT_LE(norm(sphere.evaluate({1, kPi / 2}).du), 1e-15);
  EXPECT_LE(distance(sphere.point({1, kPi / 2}), {3, -2, 9}), 1e-14);
}

TEST(EllipseCurve, is_an_ellipse_about_its_frame) {
  const EllipseCurve e(kTilted, 5, 2, 0, 6.28);
  for (double t = 0; t < 6.3; t += 0.3) {
    const CurvePoint p = e.evaluate(t);
    const Vec3 d = p.x - kTilted.origin;
    EXPECT_NEAR(std::pow(dot(d, kTilted.x) / 5, 2) + std::pow(dot(d, kTilted.y) / 2, 2), 1, 1e-14);
    EXPECT_LE(distance(p.d2, -d), 1e-14);
    EXPECT_LE(distance(p.d1, (e.point(t + 1e-6) - e.point(t - 1e-6)) / 2e-6), 1e-8);
  }
}

TEST(LineCurve, and_plane_are_straight) {
  const LineCurve line({1, 2, 3}, {0, 0, 2}, 0, 4);
  EXPECT_TRUE(line.point(1.5) == (Vec3{1, 2, 6}));
  EXPECT_TRUE(line.evaluate(1).d1 == (Vec3{0, 0, 2}));
  const PlaneSurface plane(kTilted, 0, 1, 0, 1);
  EXPECT_TRUE(plane.is_planar());
  EXPECT_LE(distance(plane.point({5, 10}), {3 + 3 - 8, -2 + 4 + 6, 5}), 1e-14);
  EXPECT_TRUE(plane.evaluate2({1, 1}).duv == Vec3{});
}

}  // namespace
}  // namespace st
