// The rest of a closed surface beside a face.
#include "geometry/import/other_side.h"

#include <BRepAlgoAPI_Common.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <TopoDS_Face.hxx>
#include <cmath>

#include <gtest/gtest.h>

#include "geometry/brep/faces_of.h"

namespace st {
namespace {

constexpr double kBall = 4 * M_PI * 25;  // area, radius 5

double area_of(const TopoDS_Shape& face) {
  GProp_GProps area;
  BRepGProp::SurfaceProperties(face, area, 1e-9);
  return area.Mass();
}

/// The face of a shape that lies on a ball.
TopoDS_Face on_ball(const TopoDS_Shape& shape) {
  for (const TopoDS_Face& face : occt::faces_of(shape))
    if (BRep_Tool::Surface(face)->IsKind(STANDARD_TYPE(Geom_SphericalSurface))) return face;
  return {};
}

void expect_rest(const TopoDS_Face& face, double area) {
  ASSERT_TRUE(occt::may_be_on_either_side(face));
  EXPECT_NEAR(area_of(face), area, 1e-4);
  const TopoDS_Face rest = occt::other_side(face);
  ASSERT_FALSE(rest.IsNull());
  EXPECT_NEAR(area_of(rest), kBall - area, 1e-4);
  EXPECT_NE(rest.Orientation(), face.Orientation());
  EXPECT_TRUE(BRepCheck_Analyzer(rest).IsValid());
}

TEST(OtherSide, of_slices_between_poles_is_the_larger_or_smaller_slice) {
  for (const double angle : {0.3, 1.5, 3.2, 5.9})
    expect_rest(on_ball(BRepPrimAPI_MakeSphere(5, angle).Shape()), kBall * angle / (2 * M_PI));
}

TEST(OtherSide, of_a_cap_is_the_ball_around_it) {
  const TopoDS_Shape beside = BRepPrimAPI_MakeBox(gp_Pnt(-9, -9, -9), gp_Pnt(-2, 9, 9)).Shape();
  const TopoDS_Shape cap = BRepAlgoAPI_Common(BRepPrimAPI_MakeSphere(5).Shape(), beside).Shape();
  expect_rest(on_ball(cap), 2 * M_PI * 5 * 3);
}

TEST(OtherSide, of_a_cap_of_a_spline_is_the_rest_of_that) {
  const TopoDS_Shape ball = BRepBuilderAPI_NurbsConvert(BRepPrimAPI_MakeSphere(5).Shape()).Shape();
  const TopoDS_Shape beside = BRepPrimAPI_MakeBox(gp_Pnt(-9, -9, -9), gp_Pnt(-2, 9, 9)).Shape();
  for (const TopoDS_Face& face : occt::faces_of(BRepAlgoAPI_Common(ball, beside).Shape()))
    if (BRep_Tool::Surface(face)->IsKind(STANDARD_TYPE(Geom_BSplineSurface))) expect_rest(face, 2 * M_PI * 5 * 3);
}

TEST(OtherSide, is_not_asked_of_faces_with_a_seam_or_a_border) {
  EXPECT_FALSE(occt::may_be_on_either_side(on_ball(BRepPrimAPI_MakeSphere(5).Shape())));
  EXPECT_FALSE(occt::may_be_on_either_side(occt::faces_of(BRepPrimAPI_MakeBox(1, 2, 3).Shape())[0]));
}

}  // namespace
}  // namespace st
