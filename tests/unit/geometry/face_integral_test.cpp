// Areas and volumes that the import stores, against sums over fine grids and mathematics.
#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRep_Builder.hxx>
#include <gp_Pln.hxx>

#include <cmath>

#include "geometry/brep/face_integral.h"
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

TopoDS_Wire square(double half, bool is_turned) {
  const int order[2][4] = {{0, 1, 2, 3}, {0, 3, 2, 1}};
  BRepBuilderAPI_MakePolygon polygon;
  for (const int k : order[is_turned]) polygon.Add(gp_Pnt(k == 1 || k == 2 ? half : -half, k >= 2 ? half : -half, 0));
  polygon.Close();
  return polygon.Wire();
}

TEST(FaceIntegral, of_a_face_whose_hole_runs_as_the_outer_loop_is_that_of_the_face) {
  for (const bool outer : {false, true})
    for (const bool hole : {false, true}) {
      TopoDS_Face face = BRepBuilderAPI_MakeFace(gp_Pln(), square(2, outer), false).Face();
      BRep_Builder().Add(face, square(1, hole));
      const occt::FaceIntegral integral = occt::integrate_face(occt::make_domain(face), {0, 0, -3});
      EXPECT_NEAR(std::fabs(integral.area), 12, 1e-9) << outer << hole;
      if (outer == hole) {
        EXPECT_NEAR(integral.volume, 12, 1e-9) << "of the side that du x dv points to";
      }
    }
}

}  // namespace
}  // namespace st
