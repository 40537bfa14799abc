#include "geometry/shape/curve.h"
#include "geometry/import/import.h"

#include <gtest/gtest.h>

#include "geometry/shape/analytic.h"
#include "support/shapes.h"

namespace st {
namespace {

const Frame kFrame{{1, 2, 3}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

TEST(ArcLength, of_a_circle_is_two_pi_r) {
  EXPECT_NEAR(arc_length(EllipseCurve(kFrame, 7, 7, 0, 2 * kPi), 0, 2 * kPi), 14 * kPi, 1e-12);
}

TEST(ArcLength, of_an_ellipse_is_its_elliptic_integral) {
  EXPECT_NEAR(arc_length(EllipseCurve(kFrame, 2, 1, 0, 2 * kPi), 0, 2 * kPi, 32), 9.688448220547675, 1e-11);
}

TEST(ArcLength, of_a_line_counts_the_length_of_its_direction) {
  EXPECT_NEAR(arc_length(LineCurve({}, {0, 3, 4}, 0, 2), 0.5, 2), 7.5, 1e-14);
}

TEST(ArcLength, is_additive) {
  const EllipseCurve e(kFrame, 5, 1, 0, 6);
  EXPECT_NEAR(arc_length(e, 0, 2, 64) + arc_length(e, 2, 6, 64), arc_length(e, 0, 6, 128), 1e-9);
}

TEST(ArcLength, of_all_edges_is_as_opencascade_says) {
  for (const char* shape :
       {"box", "drilled_cylinder", "wave", "rational_wave", "periodic_tube", "revolution", "offset", "stretched"}) {
    const ImportResult r = test::import_shape(shape);
    const test::Oracle oracle(r.brep);
    for (EdgeId e = 0; e < r.tables.n_edges(); ++e) {
      const double length = r.tables.edge_is_degenerate[e] ? 0.0 : oracle.edge_length(e);
      EXPECT_NEAR(r.tables.edge_length[e], length, 1e-4 * length) << shape << " edge " << e;
    }
  }
}

TEST(CurveCurvature, of_a_circle_is_one_over_r) {
  EXPECT_NEAR(curvature(EllipseCurve(kFrame, 4, 4, 0, 6).evaluate(1)), 0.25, 1e-15);
  EXPECT_NEAR(curvature(EllipseCurve(kFrame, 4, 2, 0, 6).evaluate(0)), 4 / 4.0, 1e-15);  // a / b^2
  EXPECT_EQ(curvature(LineCurve({}, {0, 3, 4}, 0, 2).evaluate(1)), 0);
  EXPECT_EQ(curvature(CurvePoint{}), 0);
}

TEST(CurvePeriod, brings_back_the_same_point) {
  const EllipseCurve e(kFrame, 4, 2, 1, 2);
  EXPECT_LE(distance(e.point(1.3), e.point(1.3 + e.period())), 1e-14);
  EXPECT_EQ(LineCurve({}, {1, 0, 0}, 0, 1).period(), 0);
}

}  // namespace
}  // namespace st
