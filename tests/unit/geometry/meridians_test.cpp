// Meridians that go on beyond the axis.
#include "geometry/import/meridians.h"

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom_Circle.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <gp_Circ.hxx>

#include <gtest/gtest.h>

#include <cmath>

#include "base/vec.h"
#include "geometry/brep/faces_of.h"
#include "unit/geometry/broken_import.h"

namespace st {
namespace {

/// Of a circle of radius 2 in the plane of x and z, its centre at x; between angles of the circle.
TopoDS_Face revolved(double x, double from, double to, double angle = 1) {
  const gp_Ax2 axes(gp_Pnt(x, 0, 0), gp_Dir(0, -1, 0), gp_Dir(1, 0, 0));
  const Handle(Geom_Surface) surface = new Geom_SurfaceOfRevolution(new Geom_Circle(axes, 2), gp::OZ());
  return BRepBuilderAPI_MakeFace(surface, 0, angle, from, to, 1e-7).Face();
}

struct Bounds {
  double v_min = 0, v_max = 0;
};
Bounds bounds_of(const TopoDS_Face& face) {
  double u_min, u_max;
  Bounds b;
  BRep_Tool::Surface(face)->Bounds(u_min, u_max, b.v_min, b.v_max);
  return b;
}

TEST(Meridians, end_at_the_tips_around_the_face) {
  const double tip = std::acos(-0.5);  // of the outer part: from -tip to tip
  const TopoDS_Face inner = revolved(1, tip + 0.1, 2 * kPi - tip - 0.1);
  const gp_Pnt before = BRep_Tool::Surface(inner)->Value(0.5, 3);
  EXPECT_EQ(occt::trim_meridians(occt::faces_of(inner)), 1);
  EXPECT_NEAR(bounds_of(inner).v_min, tip, 1e-9);
  EXPECT_NEAR(bounds_of(inner).v_max, 2 * kPi - tip, 1e-9);
  EXPECT_LT(BRep_Tool::Surface(inner)->Value(0.5, 3).Distance(before), 1e-12);
  EXPECT_EQ(occt::trim_meridians(occt::faces_of(inner)), 0) << "it ends there now";
}

/// A shell of one face: all around both ways, of a circle as above.
TopoDS_Shape bare_shell(double x, TopAbs_Orientation side) {
  TopoDS_Shell shell;
  BRep_Builder().MakeShell(shell);
  const TopoDS_Shape face = revolved(x, 0, 2 * kPi, 2 * kPi);
  BRep_Builder().Add(shell, face.Oriented(side));
  return shell;
}

TEST(Meridians, of_a_bare_face_become_what_it_bounds) {
  const double tip = std::acos(-0.5);
  const TopoDS_Shape apple = bare_shell(1, TopAbs_FORWARD), lemon = bare_shell(1, TopAbs_REVERSED);
  EXPECT_EQ(occt::trim_bare_meridians(apple), 1);
  EXPECT_NEAR(bounds_of(occt::faces_of(apple)[0]).v_max - bounds_of(occt::faces_of(apple)[0]).v_min, 2 * tip, 1e-9);
  EXPECT_EQ(occt::trim_bare_meridians(lemon), 1);
  EXPECT_NEAR(bounds_of(occt::faces_of(lemon)[0]).v_min, tip, 1e-9);
  EXPECT_NEAR(bounds_of(occt::faces_of(lemon)[0]).v_max, 2 * kPi - tip, 1e-9);
  EXPECT_EQ(occt::trim_bare_meridians(bare_shell(3, TopAbs_FORWARD)), 0) << "a ring";
}

TEST(Meridians, of_a_lemon_alone_make_it_whole_in_step_files) {
  const TemporaryDirectory dir;
  test::expect_whole_in_step("lemon", dir);
}

TEST(Meridians, that_do_not_cross_the_axis_stay) {
  EXPECT_EQ(occt::trim_meridians(occt::faces_of(revolved(3, 1, 2))), 0) << "a ring";
  EXPECT_EQ(occt::trim_meridians(occt::faces_of(revolved(1, 1, 4))), 0) << "a face across a tip";
}

}  // namespace
}  // namespace st
