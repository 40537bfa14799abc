// A scaled shape keeps the parameters of its edges.
#include "geometry/brep/scaled_shape.h"

#include <gtest/gtest.h>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepLib.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRep_Tool.hxx>
#include <GCE2d_MakeSegment.hxx>
#include <Geom2d_Ellipse.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <algorithm>

#include "unit/geometry/occt_shapes.h"

namespace st {
namespace {

/// Largest distance between an edge and its trimming curve at the same parameter.
double largest_gap(const TopoDS_Shape& shape) {
  double largest = 0;
  for (TopExp_Explorer f(shape, TopAbs_FACE); f.More(); f.Next()) {
    const TopoDS_Face face = TopoDS::Face(f.Current());
    const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
    for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
      double t0, t1, u0, u1;
      const Handle(Geom_Curve) curve = BRep_Tool::Curve(TopoDS::Edge(e.Current()), t0, t1);
      const Handle(Geom2d_Curve) trim = BRep_Tool::CurveOnSurface(TopoDS::Edge(e.Current()), face, u0, u1);
      if (curve.IsNull()) continue;
      EXPECT_NEAR(t0, u0, 1e-9);
      for (int k = 0; k <= 20; ++k) {
        const gp_Pnt2d uv = trim->Value(u0 + 0.05 * k * (u1 - u0));
        largest = std::max(largest, curve->Value(t0 + 0.05 * k * (t1 - t0)).Distance(surface->Value(uv.X(), uv.Y())));
      }
    }
  }
  return largest;
}

/// The piece of a cylinder between half an ellipse of its (u,v) and the ellipse's axis, as a thread has it.
TopoDS_Shape half_ellipse_on_cylinder() {
  const Handle(Geom_Surface) cylinder = new Geom_CylindricalSurface(gp_Ax2(gp_Pnt(0, 0, 60), gp::DZ()), 7);
  const Handle(Geom2d_Ellipse) ellipse =
      new Geom2d_Ellipse(gp_Ax2d(gp_Pnt2d(6.28, 5), gp_Dir2d(6.28, 2.5)), 6.28, 1.25);
  const gp_Pnt2d begin = ellipse->Value(0), end = ellipse->Value(M_PI);
  BRepBuilderAPI_MakeWire wire(BRepBuilderAPI_MakeEdge(new Geom2d_TrimmedCurve(ellipse, 0, M_PI), cylinder).Edge(),
                               BRepBuilderAPI_MakeEdge(GCE2d_MakeSegment(begin, end).Value(), cylinder).Edge());
  TopoDS_Shape face = BRepBuilderAPI_MakeFace(cylinder, wire.Wire()).Shape();
  BRepLib::BuildCurves3d(face);
  return face;
}

TEST(ScaledShape, has_trimming_curves_of_the_parameters_of_their_edges) {
  const TopoDS_Shape piece = half_ellipse_on_cylinder();
  ASSERT_LT(largest_gap(piece), 1e-4);
  for (const double factor : {2.0, 0.001}) {
    gp_Trsf scale;
    scale.SetScale(gp_Pnt(1, 2, 3), factor);
    EXPECT_LT(largest_gap(occt::scaled_shape(piece, scale).Shape()), factor * largest_gap(piece) + 1e-7 * factor);
  }
}

TEST(ScaledShape, is_that_of_opencascade_where_nothing_changes_its_parameters) {
  gp_Trsf scale;
  scale.SetScale(gp_Pnt(1, 2, 3), 25.4);
  for (const char* name : {"drilled_cylinder", "cone", "torus", "wave", "extrusion", "revolution"}) {
    const TopoDS_Shape shape = test::occt_shape(name);
    const TopoDS_Shape scaled = occt::scaled_shape(shape, scale).Shape();
    EXPECT_LT(largest_gap(scaled), 25.4 * largest_gap(shape) + 1e-6) << name;
    TopExp_Explorer a(scaled, TopAbs_FACE), b(BRepBuilderAPI_Transform(shape, scale, true).Shape(), TopAbs_FACE);
    for (; a.More(); a.Next(), b.Next()) {
      TopExp_Explorer e(a.Current(), TopAbs_EDGE), o(b.Current(), TopAbs_EDGE);
      for (; e.More(); e.Next(), o.Next()) {
        double t0, t1;
        const auto own = BRep_Tool::CurveOnSurface(TopoDS::Edge(e.Current()), TopoDS::Face(a.Current()), t0, t1);
        const auto other = BRep_Tool::CurveOnSurface(TopoDS::Edge(o.Current()), TopoDS::Face(b.Current()), t0, t1);
        EXPECT_EQ(own->DynamicType(), other->DynamicType()) << name;
        EXPECT_EQ(own->Value(0.3 * t0 + 0.7 * t1).X(), other->Value(0.3 * t0 + 0.7 * t1).X()) << name;
      }
    }
  }
}

}  // namespace
}  // namespace st
