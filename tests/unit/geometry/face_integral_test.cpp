// Areas and volumes that the import stores, against sums over fine grids and mathematics.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/import/import.h"
#include "geometry/model/model.h"
#include "support/shapes.h"

namespace st {
namespace {

/// Sum over the midpoints of an n x n grid of the whole uv rectangle, whose lines meet the kinks of the shapes.
double grid_area(const Surface& s, int n) {
  const double du = (s.u_max() - s.u_min()) / n, dv = (s.v_max() - s.v_min()) / n;
  double area = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const SurfacePoint p = s.evaluate({s.u_min() + (i + 0.5) * du, s.v_min() + (j + 0.5) * dv});
      area += norm(cross(p.du, p.dv)) * du * dv;
    }
  return area;
}

class WholeSurface : public testing::TestWithParam<const char*> {};

TEST_P(WholeSurface, has_the_area_of_a_fine_grid) {
  const ImportResult r = test::import_shape(GetParam());
  const Model model(r.tables, r.brep);
  const double expected = grid_area(*model.surface(0), 1200);
  EXPECT_NEAR(r.tables.face_area[0], expected, 2e-5 * expected);
}

INSTANTIATE_TEST_SUITE_P(FaceIntegral, WholeSurface,
                         testing::Values("wave", "rational_wave", "high_degree_wave", "kinked", "bezier", "stretched",
                                         "periodic_tube", "closed_tube", "tube_window", "rational_torus", "revolution",
                                         "extrusion", "offset", "cone_side", "sphere_octant"),
                         [](const auto& info) { return std::string(info.param); });

TEST(FaceIntegral, volumes_are_exact_to_six_digits_wherever_the_solid_lies) {
  EXPECT_NEAR(test::import_shape("sphere").volume, 4000 * kPi / 3, 1e-6 * 4000);
  EXPECT_NEAR(test::import_shape("torus").volume, 1440 * kPi * kPi, 1e-6 * 14000);
  EXPECT_NEAR(test::import_shape("drilled_block").volume, 48000 - 320 * kPi, 1e-6 * 48000);
  EXPECT_NEAR(*test::import_shape("two_boxes").tables.volume, 2000, 1e-6 * 2000);
  EXPECT_FALSE(test::import_shape("square").tables.volume);
}

}  // namespace
}  // namespace st
