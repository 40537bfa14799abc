// Surfaces through each other and through themselves.
#include "geometry/shape/surface_crossing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/shape/analytic.h"
#include "support/shapes.h"

namespace st {
namespace {

/// The loop (u^2 - 1, u^3 - u), 1 high: one point at u = -1 and 1.
class Loop : public Surface {
 public:
  Loop(double from, double to) { u_min_ = from, u_max_ = to; }
  Vec3 point(Vec2 uv) const override { return evaluate(uv).x; }
  SurfacePoint evaluate(Vec2 uv) const override {
    const double u = uv.x;
    return {{u * u - 1, u * u * u - u, uv.y}, {2 * u, 3 * u * u - 1, 0}, {0, 0, 1}};
  }
  SurfacePoint2 evaluate2(Vec2 uv) const override {
    const SurfacePoint p = evaluate(uv);
    return {p.x, p.du, p.dv, {2, 6 * uv.x, 0}, {}, {}};
  }
};

constexpr double kTolerance = 1e-6;
bool everywhere(Vec2) { return true; }

TEST(CommonPoint, is_on_both_surfaces) {
  const Loop a(-2, 0), b(0, 2);
  const auto p = common_point(a, {-1.3, 0.4}, b, {0.8, 0.6}, 1e-12);
  ASSERT_TRUE(p);
  EXPECT_NEAR(p->uv_a.x, -1, 1e-9);
  EXPECT_NEAR(p->uv_b.x, 1, 1e-9);
  EXPECT_NEAR(p->sine, 1, 1e-9) << "(2, 2) and (-2, 2) are at right angles";
  EXPECT_LE(distance(p->x, b.point(p->uv_b)), 1e-12);
}

TEST(CommonPoint, is_none_of_surfaces_apart) {
  const Frame frame{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const AxialSurface inner(SurfaceType::kCylinder, frame, 1, 0, 0, 6, 0, 1),
      outer(SurfaceType::kCylinder, frame, 2, 0, 0, 6, 0, 1);
  EXPECT_FALSE(common_point(inner, {1, 0.5}, outer, {1, 0.5}, 1e-9));
}

TEST(SelfCrossing, is_found_where_two_places_are_one_point) {
  const Loop loop(-1.5, 1.7);
  const auto p = find_self_crossing(loop, kTolerance, everywhere);
  ASSERT_TRUE(p);
  EXPECT_NEAR(std::hypot(p->x.x, p->x.y), 0, 1e-8);
  EXPECT_NEAR(p->uv_a.x * p->uv_b.x, -1, 1e-8);
}

/// A ribbon along u whose width is that of `width(u)`: negative beyond a pinch.
class Ribbon : public Surface {
 public:
  explicit Ribbon(double pinch) : pinch_(pinch) { u_min_ = -1, u_max_ = 1, v_min_ = 0, v_max_ = 1; }
  Vec3 point(Vec2 uv) const override { return evaluate(uv).x; }
  SurfacePoint evaluate(Vec2 uv) const override {
    const double width = uv.x - pinch_;
    return {{uv.x, width * (uv.y - 0.5), 0}, {1, uv.y - 0.5, 0}, {0, width, 0}};
  }
  SurfacePoint2 evaluate2(Vec2 uv) const override {
    const SurfacePoint p = evaluate(uv);
    return {p.x, p.du, p.dv, {}, {0, 1, 0}, {}};
  }

 private:
  double pinch_;
};

TEST(Pinch, is_where_a_ribbon_shrinks_to_a_point_and_is_turned_over) {
  const auto place = find_pinch(Ribbon(0.37), kTolerance, everywhere);
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->x, 0.37, 1e-9);
  EXPECT_FALSE(find_pinch(Ribbon(0.37), kTolerance, [](Vec2 uv) { return uv.x < 0.2; }));
}

TEST(Pinch, is_no_pole_and_no_sharp_nose) {
  EXPECT_FALSE(find_pinch(Ribbon(-1), kTolerance, everywhere)) << "it ends there";
  for (const char* shape : {"sphere", "cone", "wave", "revolution", "kinked", "periodic_tube", "sharp_wing", "fan"}) {
    const Model model = test::make_model(shape);
    for (FaceId f = 0; f < model.tables().n_faces(); ++f)
      EXPECT_FALSE(find_pinch(*model.surface(f), kTolerance, everywhere)) << shape << " " << f;
  }
}

TEST(SelfCrossing, counts_only_what_is_inside) {
  EXPECT_FALSE(find_self_crossing(Loop(-1.5, 1.7), kTolerance, [](Vec2 uv) { return uv.x < 0.9; }));
  EXPECT_FALSE(find_self_crossing(Loop(-0.9, 1.7), kTolerance, everywhere));
  EXPECT_FALSE(find_self_crossing(Loop(-1, 1), kTolerance, everywhere)) << "it only closes there";
}

TEST(SelfCrossing, is_none_of_closed_surfaces_with_seams_and_poles) {
  for (const char* shape : {"sphere", "rational_torus", "closed_tube", "periodic_tube", "revolution", "offset",
                            "kinked", "bezier", "cone_side", "thin_tube"}) {
    const Model model = test::make_model(shape);
    EXPECT_FALSE(find_self_crossing(*model.surface(0), kTolerance, everywhere)) << shape;
  }
}

}  // namespace
}  // namespace st
