#include "geometry/ferguson.h"

#include <gtest/gtest.h>

#include <cmath>

namespace st {
namespace {

TEST(FergusonCurve, passes_its_points_with_their_tangents) {
  const std::vector<Vec3> x{{0, 0, 0}, {1, 2, 0}, {3, 2, 1}, {4, 0, 5}}, d{{1, 1, 0}, {2, 0, 1}, {0, -3, 2}, {1, 0, 0}};
  const auto c = ferguson_curve(x, d);
  EXPECT_EQ(c->t_max(), 3);
  for (int i = 0; i < 4; ++i) {
    const CurvePoint p = c->evaluate(i);
    EXPECT_LE(distance(p.x, x[i]), 1e-14);
    EXPECT_LE(distance(p.d1, d[i]), 1e-13);
  }
  // Hermite's formula half way
  EXPECT_LE(distance(c->point(1.5), 0.5 * (x[1] + x[2]) + 0.125 * (d[1] - d[2])), 1e-14);
  EXPECT_TRUE(c->c0_knots().empty());
  EXPECT_EQ(c->knots(), (std::vector<double>{1, 2}));
}

TEST(FergusonSurface, interpolates_values_derivatives_and_twists) {
  constexpr int kU = 4, kV = 3;
  std::vector<Vec3> x, xu, xv, xuv;
  for (int k = 0; k < kU * kV; ++k) {
    const auto some = [k](double a) { return Vec3{std::sin(a + k), std::cos(2 * a + 1.3 * k), std::sin(3 * a + 0.7 * k)}; };
    x.push_back(some(0));
    xu.push_back(some(1));
    xv.push_back(some(2));
    xuv.push_back(some(3));
  }
  const auto s = ferguson_surface({kU, kV, x, xu, xv, xuv});
  EXPECT_EQ(s->u_max(), kU - 1);
  EXPECT_EQ(s->v_max(), kV - 1);
  for (int j = 0; j < kV; ++j)
    for (int i = 0; i < kU; ++i) {
      const SurfacePoint2 p = s->evaluate2({double(i), double(j)});
      EXPECT_LE(distance(p.x, x[j * kU + i]), 1e-13);
      EXPECT_LE(distance(p.du, xu[j * kU + i]), 1e-13);
      EXPECT_LE(distance(p.dv, xv[j * kU + i]), 1e-13);
      EXPECT_LE(distance(p.duv, xuv[j * kU + i]), 1e-12);
    }
}

TEST(FergusonSurface, of_two_by_two_points_without_twist_is_bilinear) {
  const std::vector<Vec3> x{{0, 0, 0}, {1, 0, 4}, {0, 1, 2}, {1, 1, 6}}, xu(4, {1, 0, 4}), xv(4, {0, 1, 2}), xuv(4);
  const auto s = ferguson_surface({2, 2, x, xu, xv, xuv});
  EXPECT_LE(distance(s->point({0.25, 0.5}), {0.25, 0.5, 2}), 1e-14);
}

}  // namespace
}  // namespace st
