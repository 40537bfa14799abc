#include "geometry/flite/flite_spline.h"

#include <gtest/gtest.h>

#include <cmath>

namespace st {
namespace {

std::vector<Vec3> some_points(int n) {
  std::vector<Vec3> points;
  for (int k = 0; k < n; ++k) points.push_back({std::sin(1.0 + k), std::cos(1.3 * k), std::sin(0.7 * k) + k});
  return points;
}

TEST(FergusonCurve, passes_its_points_with_continuous_curvature_and_ends_without) {
  for (const int n : {2, 3, 4, 9}) {
    const std::vector<Vec3> points = some_points(n);
    const auto curve = ferguson_curve(points);
    EXPECT_EQ(curve->t_max(), n - 1);
    for (int k = 0; k < n; ++k) EXPECT_LE(distance(curve->point(k), points[k]), 1e-14 * n);
    for (int k = 1; k + 1 < n; ++k)
      EXPECT_LE(distance(curve->evaluate(k - 1e-9).d2, curve->evaluate(k + 1e-9).d2), 1e-6);
    EXPECT_LE(norm(curve->evaluate(0).d2), 1e-13);
    EXPECT_LE(norm(curve->evaluate(n - 1).d2), 1e-12);
  }
}

TEST(FergusonCurve, is_the_hermite_form_of_its_tangents) {
  const std::vector<Vec3> p = some_points(6);
  const auto curve = ferguson_curve(p);
  std::vector<Vec3> t;
  for (int k = 0; k < 6; ++k) t.push_back(curve->evaluate(k).d1);
  for (int k = 1; k < 5; ++k) EXPECT_LE(norm(t[k - 1] + 4.0 * t[k] + t[k + 1] - 3.0 * (p[k + 1] - p[k - 1])), 1e-12);
  EXPECT_LE(norm(2.0 * t[0] + t[1] - 3.0 * (p[1] - p[0])), 1e-12);
  EXPECT_LE(distance(curve->point(2.5), 0.5 * (p[2] + p[3]) + 0.125 * (t[2] - t[3])), 1e-13);
}

TEST(FergusonSurface, passes_its_grid_and_its_rows_are_ferguson_curves) {
  constexpr int kU = 5, kV = 4;
  const std::vector<Vec3> points = some_points(kU * kV);
  const auto surface = ferguson_surface(kU, kV, points);
  for (int j = 0; j < kV; ++j) {
    const auto row = ferguson_curve(std::span(points).subspan(j * kU, kU));
    for (int i = 0; i < kU; ++i) EXPECT_LE(distance(surface->point({double(i), double(j)}), points[j * kU + i]), 1e-12);
    for (const double u : {0.3, 1.7, 3.9}) EXPECT_LE(distance(row->point(u), surface->point({u, double(j)})), 1e-12);
  }
}

TEST(FergusonSurface, has_the_twists_of_the_spline_of_its_derivatives) {
  constexpr int kU = 4, kV = 5;
  const std::vector<Vec3> points = some_points(kU * kV);
  const auto surface = ferguson_surface(kU, kV, points);
  for (int i = 0; i < kU; ++i) {
    std::vector<Vec3> du;
    for (int j = 0; j < kV; ++j) du.push_back(surface->evaluate({double(i), double(j)}).du);
    const auto along_v = ferguson_curve(du);
    for (int j = 0; j < kV; ++j)
      EXPECT_LE(distance(surface->evaluate2({double(i), double(j)}).duv, along_v->evaluate(j).d1), 1e-12);
  }
}

TEST(FergusonSurface, of_two_by_two_points_is_bilinear) {
  const std::vector<Vec3> p{{0, 0, 0}, {2, 0, 1}, {0, 3, 0}, {2, 3, 5}};
  EXPECT_LE(distance(ferguson_surface(2, 2, p)->point({0.25, 0.5}),
                     0.375 * p[0] + 0.125 * p[1] + 0.375 * p[2] + 0.125 * p[3]),
            1e-15);
}

}  // namespace
}  // namespace st
