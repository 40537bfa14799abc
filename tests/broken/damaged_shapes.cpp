#include "broken/damaged_shapes.h"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepLib.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRepTools.hxx>
#include <BRepTools_ReShape.hxx>
#include <BRep_Builder.hxx>
#include <BRep_TEdge.hxx>
#include <BRep_Tool.hxx>
#include <Geom2dConvert.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Circle.hxx>
#include <Geom2d_Line.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_Curve.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Iterator.hxx>
#include <cmath>
#include <functional>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>
#include <map>
#include <stdexcept>

namespace st::test {
namespace {

using EdgeTest = std::function<bool(const TopoDS_Edge&)>;

TopTools_IndexedMapOfShape parts_of(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(shape, kind, map);
  return map;
}

/// Every edge has stored trimming curves; those chosen lose their space curve.
TopoDS_Shape without_curves(const TopoDS_Shape& shape, const EdgeTest& is_chosen) {
  const TopTools_IndexedMapOfShape faces = parts_of(shape, TopAbs_FACE), edges = parts_of(shape, TopAbs_EDGE);
  for (int f = 1; f <= faces.Extent(); ++f)
    for (TopExp_Explorer e(faces(f), TopAbs_EDGE); e.More(); e.Next())
      BRepLib::BuildPCurveForEdgeOnPlane(TopoDS::Edge(e.Current()), TopoDS::Face(faces(f)));
  for (int i = 1; i <= edges.Extent(); ++i) {
    const TopoDS_Edge edge = TopoDS::Edge(edges(i));
    if (!BRep_Tool::Degenerated(edge) && is_chosen(edge))
      BRep_Builder().UpdateEdge(edge, Handle(Geom_Curve)(), BRep_Tool::Tolerance(edge));
  }
  return shape;
}

bool is_every(const TopoDS_Edge&) { return true; }

bool is_ring(const TopoDS_Edge& edge) { return TopExp::FirstVertex(edge).IsSame(TopExp::LastVertex(edge)); }

TopoDS_Shape rod() { return BRepPrimAPI_MakeCylinder(30, 100).Shape(); }

/// Radial holes at the side, each at an angle and a height.
TopoDS_Shape rod_with_holes(const std::vector<std::pair<double, double>>& holes) {
  TopoDS_Shape shape = rod();
  for (const auto& [angle, height] : holes) {
    const gp_Ax2 axis(gp_Pnt(15 * std::cos(angle), 15 * std::sin(angle), height),
                      gp_Dir(std::cos(angle), std::sin(angle), 0));
    shape = BRepAlgoAPI_Cut(shape, BRepPrimAPI_MakeCylinder(axis, 5, 30).Shape()).Shape();
  }
  return shape;
}

TopoDS_Shape rod_hole() { return rod_with_holes({{1.6, 50}}); }

/// A quarter of a tube's side with a hole in what is not there.
TopoDS_Shape stray_hole() {
  const Handle(Geom_CylindricalSurface) surface = new Geom_CylindricalSurface(gp_Ax3(gp::XOY()), 30);
  BRepBuilderAPI_MakeFace face(surface, 0, 1.5, 0, 100, 1e-7);
  const Handle(Geom2d_Circle) circle = new Geom2d_Circle(gp_Ax2d(gp_Pnt2d(4, 50), gp_Dir2d(1, 0)), 0.5);
  face.Add(TopoDS::Wire(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(circle, surface).Edge()).Wire().Reversed()));
  BRepLib::BuildCurves3d(face.Face());
  return face.Face();
}

/// A disc with a hole so near to its rim that it lies outside the polygon of 24 sides.
TopoDS_Shape rim_hole() {
  const double angle = M_PI / 24;
  const gp_Pnt middle(9.95 * std::cos(angle), 9.95 * std::sin(angle), 0);
  const auto circle = [](const gp_Pnt& p, double radius) {
    return BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(gp_Circ(gp_Ax2(p, gp::DZ()), radius)).Edge()).Wire();
  };
  BRepBuilderAPI_MakeFace face(gp_Pln(gp::XOY()), circle(gp::Origin(), 10));
  face.Add(TopoDS::Wire(circle(middle, 0.02).Reversed()));
  return face.Face();
}

/// A hole in the plane of a box's top, beside the box. `has_tube`: another face begins at it.
TopoDS_Shape box_with_stray_hole(bool has_tube) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(60, 40, 20).Shape();
  const TopoDS_Edge circle = BRepBuilderAPI_MakeEdge(gp_Circ(gp_Ax2(gp_Pnt(100, 20, 20), gp::DZ()), 5)).Edge();
  const TopTools_IndexedMapOfShape faces = parts_of(box, TopAbs_FACE);
  BRepTools_ReShape reshape;
  for (int f = 1; f <= faces.Extent(); ++f) {
    const TopoDS_Face face = TopoDS::Face(faces(f));
    const gp_Pln plane = Handle(Geom_Plane)::DownCast(BRep_Tool::Surface(face))->Pln();
    if (plane.Distance(gp_Pnt(0, 0, 20)) + plane.Distance(gp_Pnt(60, 40, 20)) + plane.Distance(gp_Pnt(60, 0, 20)) > 1)
      continue;
    TopoDS_Shape with_hole = face.EmptyCopied().Oriented(TopAbs_FORWARD);
    for (TopoDS_Iterator w(face, false); w.More(); w.Next()) BRep_Builder().Add(with_hole, w.Value());
    const TopoDS_Wire wire = BRepBuilderAPI_MakeWire(circle).Wire();
    BRep_Builder().Add(with_hole, plane.Axis().Direction().Z() > 0 ? wire.Reversed() : wire.Oriented(TopAbs_FORWARD));
    reshape.Replace(face.Oriented(TopAbs_FORWARD), with_hole);
  }
  TopoDS_Compound all;
  BRep_Builder builder;
  builder.MakeCompound(all);
  builder.Add(all, reshape.Apply(box));
  if (has_tube) builder.Add(all, BRepPrimAPI_MakePrism(circle, gp_Vec(0, 0, 30)).Shape());
  return all;
}

/// A drilled box, of whose top the outer loop or the hole runs the wrong way.
TopoDS_Shape drilled_box_turned(bool is_outer) {
  const TopoDS_Shape box =
      BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(60, 40, 20).Shape(),
                      BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(20, 20, -1), gp::DZ()), 8, 22).Shape());
  const TopTools_IndexedMapOfShape faces = parts_of(box, TopAbs_FACE);
  BRepTools_ReShape reshape;
  for (int f = 1; f <= faces.Extent(); ++f) {
    const TopoDS_Face face = TopoDS::Face(faces(f).Oriented(TopAbs_FORWARD));
    if (face.NbChildren() != 2) continue;
    const TopoDS_Wire outer = BRepTools::OuterWire(face);
    TopoDS_Shape turned = face.EmptyCopied();
    for (TopoDS_Iterator w(face); w.More(); w.Next())
      BRep_Builder().Add(turned, w.Value().IsSame(outer) == is_outer ? w.Value().Reversed() : w.Value());
    reshape.Replace(face, turned);
    break;
  }
  return reshape.Apply(box);
}

double signed_area(const TopoDS_Wire& wire, const TopoDS_Face& face) {
  double area = 0;
  for (TopExp_Explorer e(wire, TopAbs_EDGE); e.More(); e.Next()) {
    double t0, t1;
    const Handle(Geom2d_Curve) c = BRep_Tool::CurveOnSurface(TopoDS::Edge(e.Current()), face, t0, t1);
    const double sign = e.Current().Orientation() == TopAbs_REVERSED ? -1 : 1;
    for (int k = 0; k < 16; ++k) {
      const gp_Pnt2d a = c->Value(t0 + (t1 - t0) * k / 16), b = c->Value(t0 + (t1 - t0) * (k + 1) / 16);
      area += sign * 0.5 * (a.X() + b.X()) * (b.Y() - a.Y());
    }
  }
  return area;
}

/// Moves the trimming curves of holes (or of the outer loop) of faces that have several loops and are no planes.
/// `which`: number of the hole; -1: the outer loop; -2: every loop.
TopoDS_Shape with_moved_loop(const TopoDS_Shape& shape, int which, double periods_u, double periods_v,
                             bool is_nearly_closed = false) {
  const TopTools_IndexedMapOfShape faces = parts_of(shape, TopAbs_FACE);
  for (int f = 1; f <= faces.Extent(); ++f) {
    const TopoDS_Face face = TopoDS::Face(faces(f).Oriented(TopAbs_FORWARD));
    const Handle(Geom_Surface) s = BRep_Tool::Surface(face);
    if (parts_of(face, TopAbs_WIRE).Extent() < 2 || !(s->IsUClosed() || is_nearly_closed)) continue;
    double u0, u1, v0, v1;
    s->Bounds(u0, u1, v0, v1);
    const gp_Vec2d by(periods_u * (u1 - u0), periods_v == 0 ? 0 : periods_v * (v1 - v0));
    int hole = 0;
    for (TopoDS_Iterator w(face); w.More(); w.Next()) {
      const bool is_hole = signed_area(TopoDS::Wire(w.Value()), face) < 0;
      if (which == -2 || (is_hole ? hole == which : which == -1)) {
        const TopTools_IndexedMapOfShape edges = parts_of(w.Value(), TopAbs_EDGE);
        for (int i = 1; i <= edges.Extent(); ++i) {
          const TopoDS_Edge edge = TopoDS::Edge(edges(i).Oriented(TopAbs_FORWARD));
          double t0, t1;
          const auto moved = [&](const TopoDS_Shape& side) {
            return Handle(Geom2d_Curve)::DownCast(
                BRep_Tool::CurveOnSurface(TopoDS::Edge(side), face, t0, t1)->Translated(by));
          };
          if (BRep_Tool::IsClosed(edge, face))
            BRep_Builder().UpdateEdge(edge, moved(edge), moved(edge.Reversed()), face, 1e-7);
          else
            BRep_Builder().UpdateEdge(edge, moved(edge), face, 1e-7);
          BRep_Builder().Range(edge, face, t0, t1);
        }
      }
      hole += is_hole;
    }
  }
  return shape;
}

/// The side of the rod as a B-spline that is only closed.
TopoDS_Shape as_closed_spline(const TopoDS_Shape& shape, bool is_periodic) {
  const TopoDS_Shape spline = BRepBuilderAPI_NurbsConvert(shape, true).Shape();
  const TopTools_IndexedMapOfShape faces = parts_of(spline, TopAbs_FACE);
  for (int f = 1; f <= faces.Extent(); ++f) {
    TopLoc_Location where;
    const auto s = Handle(Geom_BSplineSurface)::DownCast(BRep_Tool::Surface(TopoDS::Face(faces(f)), where));
    if (s.IsNull() || !s->IsUClosed()) continue;
    if (is_periodic && !s->IsUPeriodic()) s->SetUPeriodic();
    if (!is_periodic && s->IsUPeriodic()) s->SetUNotPeriodic();
  }
  return spline;
}

/// The side of the rod as a spline whose ends miss each other by less than its edges' tolerance: not closed for
/// OpenCASCADE.
TopoDS_Shape as_nearly_closed_spline(const TopoDS_Shape& shape) {
  const TopoDS_Shape spline = as_closed_spline(shape, false);
  const TopTools_IndexedMapOfShape faces = parts_of(spline, TopAbs_FACE), edges = parts_of(spline, TopAbs_EDGE);
  for (int f = 1; f <= faces.Extent(); ++f) {
    TopLoc_Location where;
    const auto s = Handle(Geom_BSplineSurface)::DownCast(BRep_Tool::Surface(TopoDS::Face(faces(f)), where));
    if (s.IsNull() || !s->IsUClosed()) continue;
    for (int j = 1; j <= s->NbVPoles(); ++j)
      s->SetPole(s->NbUPoles(), j, s->Pole(s->NbUPoles(), j).Translated(gp_Vec(1e-5, 0, 0)));
  }
  for (int i = 1; i <= edges.Extent(); ++i) BRep_Builder().UpdateEdge(TopoDS::Edge(edges(i)), 1e-4);
  return spline;
}

/// Without the edge from bottom to top: loops that go around.
TopoDS_Shape without_seam(const TopoDS_Shape& shape) {
  const TopTools_IndexedMapOfShape faces = parts_of(shape, TopAbs_FACE);
  BRep_Builder builder;
  for (int f = 1; f <= faces.Extent(); ++f) {
    TopoDS_Face face = TopoDS::Face(faces(f).Oriented(TopAbs_FORWARD));
    const TopTools_IndexedMapOfShape wires = parts_of(face, TopAbs_WIRE);
    for (int k = 1; k <= wires.Extent(); ++k) {
      const TopoDS_Shape wire = wires(k);
      std::vector<TopoDS_Shape> others;
      bool has_seam = false;
      for (TopoDS_Iterator e(wire); e.More(); e.Next())
        if (BRep_Tool::IsClosed(TopoDS::Edge(e.Value()), face))
          has_seam = true;
        else
          others.push_back(e.Value());
      if (!has_seam) continue;
      face.Free(true);
      builder.Remove(face, wire);
      for (const TopoDS_Shape& edge : others) {
        TopoDS_Wire ring;
        builder.MakeWire(ring);
        builder.Add(ring, edge);
        builder.Add(face, ring);
      }
    }
  }
  return shape;
}

/// The straight line between the ends, in its parameters.
Handle(Geom2d_Curve) straight(const Handle(Geom2d_Curve) & curve, double t0, double t1, double s0, double s1) {
  TColgp_Array1OfPnt2d poles(1, 2);
  TColStd_Array1OfReal knots(1, 2);
  TColStd_Array1OfInteger multiplicities(1, 2);
  poles(1) = curve->Value(t0), poles(2) = curve->Value(t1);
  knots(1) = s0, knots(2) = s1;
  multiplicities(1) = multiplicities(2) = 2;
  return new Geom2d_BSplineCurve(poles, knots, multiplicities, 1);
}

/// A hole whose loop has two edges: on the rod they are straight in (u,v), on its own wall they are right.
TopoDS_Shape no_curve_disagree() {
  const TopoDS_Shape shape = rod_with_holes({{1.6, 50}, {4.0, 50}});
  const TopoDS_Shape cut = BRepAlgoAPI_Cut(shape, BRepPrimAPI_MakeBox(gp_Pnt(-40, 20, 48), 80, 40, 4).Shape()).Shape();
  const TopTools_IndexedMapOfShape faces = parts_of(cut, TopAbs_FACE);
  TopTools_MapOfShape changed;
  for (int f = 1; f <= faces.Extent(); ++f) {
    const TopoDS_Face face = TopoDS::Face(faces(f).Oriented(TopAbs_FORWARD));
    if (parts_of(face, TopAbs_WIRE).Extent() < 2) continue;
    for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
      const TopoDS_Edge edge = TopoDS::Edge(e.Current().Oriented(TopAbs_FORWARD));
      double t0, t1;
      const Handle(Geom2d_Curve) c = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
      if (is_ring(edge) || BRep_Tool::IsClosed(edge, face) || c->IsKind(STANDARD_TYPE(Geom2d_Line)) ||
          !changed.Add(edge))
        continue;
      BRep_Builder().UpdateEdge(edge, straight(c, t0, t1, t0, t1), face, 1e-7);
      BRep_Builder().Range(edge, face, t0, t1);
    }
  }
  return without_curves(cut, [&](const TopoDS_Edge& edge) { return changed.Contains(edge); });
}

/// The circles of a rod, from 0 to 1 on the planes.
TopoDS_Shape no_curve_ranges() {
  const TopoDS_Shape shape = without_curves(rod(), [](const TopoDS_Edge& edge) { return is_ring(edge); });
  const TopTools_IndexedMapOfShape faces = parts_of(shape, TopAbs_FACE);
  for (int f = 1; f <= faces.Extent(); ++f) {
    const TopoDS_Face face = TopoDS::Face(faces(f).Oriented(TopAbs_FORWARD));
    if (parts_of(face, TopAbs_EDGE).Extent() > 1) continue;
    const TopoDS_Edge edge = TopoDS::Edge(TopExp_Explorer(face, TopAbs_EDGE).Current().Oriented(TopAbs_FORWARD));
    double t0, t1;
    const Handle(Geom2d_Curve) c = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
    const Handle(Geom2d_BSplineCurve) s =
        Geom2dConvert::CurveToBSplineCurve(new Geom2d_TrimmedCurve(c, t0, t1), Convert_QuasiAngular);
    TColStd_Array1OfReal knots(1, s->NbKnots());
    s->Knots(knots);
    for (int k = 1; k <= knots.Length(); ++k) knots(k) = (knots(k) - t0) / (t1 - t0);
    s->SetKnots(knots);
    BRep_Builder().UpdateEdge(edge, s, face, 1e-7);
    BRep_Builder().Range(edge, face, 0, 1);
    BRep_Builder().SameRange(edge, false);
    BRep_Builder().SameParameter(edge, false);
  }
  return shape;
}

TopoDS_Shape no_curve_pole() {
  const TopoDS_Shape shape = BRepPrimAPI_MakeSphere(10).Shape();
  const TopTools_IndexedMapOfShape edges = parts_of(shape, TopAbs_EDGE);
  for (int i = 1; i <= edges.Extent(); ++i) BRep_Builder().Degenerated(TopoDS::Edge(edges(i)), false);
  return shape;
}

/// A plate with a hole of six sides in one edge.
TopoDS_Shape no_curve_bent() {
  const TopoDS_Face plate =
      TopoDS::Face(BRepBuilderAPI_MakeFace(gp_Pln(gp::XOY()), -20, 20, -20, 20).Shape().Oriented(TopAbs_FORWARD));
  TColgp_Array1OfPnt2d poles(1, 7);
  TColStd_Array1OfReal knots(1, 7);
  TColStd_Array1OfInteger multiplicities(1, 7);
  for (int k = 0; k <= 6; ++k) {
    poles(k + 1) = gp_Pnt2d(10 * std::cos(k * M_PI / 3), -10 * std::sin(k * M_PI / 3));
    knots(k + 1) = k;
    multiplicities(k + 1) = k == 0 || k == 6 ? 2 : 1;
  }
  poles(7) = poles(1);
  BRep_Builder builder;
  TopoDS_Vertex vertex;
  builder.MakeVertex(vertex, gp_Pnt(10, 0, 0), 1e-7);
  TopoDS_Edge edge;
  builder.MakeEdge(edge);
  builder.UpdateEdge(edge, Handle(Geom2d_Curve)(new Geom2d_BSplineCurve(poles, knots, multiplicities, 1)), plate, 1e-7);
  builder.Range(edge, plate, 0, 6);
  builder.Add(edge, vertex.Oriented(TopAbs_FORWARD));
  builder.Add(edge, vertex.Oriented(TopAbs_REVERSED));
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  builder.Add(wire, edge);
  wire.Closed(true);
  TopoDS_Shape face = plate;
  face.Free(true);
  builder.Add(face, wire);
  return face;
}

void lose_all_curves(const TopoDS_Edge& edge) { Handle(BRep_TEdge)::DownCast(edge.TShape())->ChangeCurves().Clear(); }

/// A rod whose upper circle has no curve at all.
TopoDS_Shape no_curve_lost() {
  const TopoDS_Shape shape = rod();
  const TopTools_IndexedMapOfShape edges = parts_of(shape, TopAbs_EDGE);
  for (int i = 1; i <= edges.Extent(); ++i) {
    const TopoDS_Edge edge = TopoDS::Edge(edges(i));
    if (is_ring(edge) && BRep_Tool::Pnt(TopExp::FirstVertex(edge)).Z() > 50) lose_all_curves(edge);
  }
  return shape;
}

/// A sphere of radius 10, the space curve of whose seam has a pole moved by 5.
TopoDS_Shape bumped_seam() {
  const TopoDS_Shape shape = BRepPrimAPI_MakeSphere(10).Shape();
  const TopTools_IndexedMapOfShape edges = parts_of(shape, TopAbs_EDGE);
  for (int i = 1; i <= edges.Extent(); ++i) {
    const TopoDS_Edge edge = TopoDS::Edge(edges(i));
    double t0, t1;
    if (BRep_Tool::Degenerated(edge)) continue;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, t0, t1);
    const Handle(Geom_BSplineCurve) spline =
        GeomConvert::CurveToBSplineCurve(new Geom_TrimmedCurve(curve, t0, t1), Convert_QuasiAngular);
    const int middle = (1 + spline->NbPoles()) / 2;
    spline->SetPole(middle, spline->Pole(middle).Translated(gp_Vec(5, 0, 0)));
    BRep_Builder().UpdateEdge(edge, spline, 1e-7);
    BRep_Builder().Range(edge, t0, t1);
  }
  return shape;
}

/// A ruled band of radius 10 and width 4 that is twisted by half a turn: its ends are one line, run through both ways.
TopoDS_Shape twisted_band() {
  constexpr int n = 33;
  TColgp_Array2OfPnt poles(1, n, 1, 2);
  TColStd_Array1OfReal u_knots(1, n - 2), v_knots(1, 2);
  TColStd_Array1OfInteger u_multiplicities(1, n - 2), v_multiplicities(1, 2);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 2; ++j) {
      const double a = 2 * M_PI * i / (n - 1), w = j == 0 ? -2 : 2, r = 10 + w * std::cos(a / 2);
      poles(i + 1, j + 1) = gp_Pnt(r * std::cos(a), r * std::sin(a), w * std::sin(a / 2));
    }
  for (int k = 1; k <= n - 2; ++k) {
    u_knots(k) = k - 1;
    u_multiplicities(k) = k == 1 || k == n - 2 ? 4 : 1;
  }
  v_knots(1) = 0, v_knots(2) = 1;
  v_multiplicities(1) = v_multiplicities(2) = 2;
  const Handle(Geom_BSplineSurface) surface =
      new Geom_BSplineSurface(poles, u_knots, v_knots, u_multiplicities, v_multiplicities, 3, 1);
  return BRepBuilderAPI_MakeFace(surface, 1e-7).Shape();
}

TopoDS_Shape no_curve_box(bool has_trimming_curves, bool is_marked) {
  const TopoDS_Shape shape = BRepPrimAPI_MakeBox(60, 40, 20).Shape();
  const TopoDS_Edge first = TopoDS::Edge(TopExp_Explorer(shape, TopAbs_EDGE).Current());
  if (!has_trimming_curves) {
    lose_all_curves(first);
    return shape;
  }
  without_curves(shape, [&](const TopoDS_Edge& edge) { return !is_marked || edge.IsSame(first); });
  if (is_marked) BRep_Builder().Degenerated(first, true);
  return shape;
}

/// A gutter, offset to the inside by more than the radius of its bottom.
TopoDS_Shape folded_offset() {
  TColgp_Array2OfPnt poles(1, 5, 1, 2);
  const gp_Pnt section[] = {{-20, 0, 10}, {-8, 0, 0}, {0, 0, -8}, {8, 0, 0}, {20, 0, 10}};
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 2; ++j) poles(i + 1, j + 1) = section[i].Translated(gp_Vec(0, 30 * j, 0));
  TColStd_Array1OfReal u_knots(1, 3), v_knots(1, 2);
  TColStd_Array1OfInteger u_multiplicities(1, 3), v_multiplicities(1, 2);
  u_knots(1) = 0, u_knots(2) = 1, u_knots(3) = 2, v_knots(1) = 0, v_knots(2) = 1;
  u_multiplicities(1) = u_multiplicities(3) = 4, u_multiplicities(2) = 1;
  v_multiplicities(1) = v_multiplicities(2) = 2;
  const Handle(Geom_BSplineSurface) surface =
      new Geom_BSplineSurface(poles, u_knots, v_knots, u_multiplicities, v_multiplicities, 3, 1);
  return BRepBuilderAPI_MakeFace(new Geom_OffsetSurface(surface, 8), 1e-7).Shape();
}

TopoDS_Shape torus_hole() {
  const gp_Ax2 axis(gp_Pnt(0, 40, 0), gp_Dir(0, 1, 0));
  return BRepAlgoAPI_Cut(BRepPrimAPI_MakeTorus(40, 10).Shape(),
                         BRepPrimAPI_MakeCylinder(gp_Ax2(axis.Location(), gp_Dir(0, 0.8, 0.6)), 3, 30).Shape())
      .Shape();
}

using Makers = std::map<std::string, std::function<TopoDS_Shape()>>;

Makers makers() {
  return {
      {"no_curve_ring", [] { return without_curves(rod(), is_ring); }},
      {"no_curve_all",
       [] {
         const gp_Ax2 across(gp_Pnt(0, 0, 15), gp_Dir(1, 0, 0));
         return without_curves(
             BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(10, 30).Shape(), BRepPrimAPI_MakeCylinder(across, 3, 20).Shape())
                 .Shape(),
             is_every);
       }},
      {"no_curve_torus", [] { return without_curves(BRepPrimAPI_MakeTorus(40, 10).Shape(), is_every); }},
      {"no_curve_box", [] { return no_curve_box(true, false); }},
      {"no_curve_false_pole", [] { return no_curve_box(true, true); }},
      {"no_curve_at_all", [] { return no_curve_box(false, false); }},
      {"no_curve_disagree", no_curve_disagree},
      {"no_curve_ranges", no_curve_ranges},
      {"no_curve_pole", no_curve_pole},
      {"no_curve_bent", no_curve_bent},
      {"no_curve_lost", no_curve_lost},
      {"bumped_seam", bumped_seam},
      {"twisted_band", twisted_band},
      {"folded_offset", folded_offset},
      {"rod_hole", rod_hole},
      {"rod_hole_p1", [] { return with_moved_loop(rod_hole(), 0, 1, 0); }},
      {"rod_hole_m3", [] { return with_moved_loop(rod_hole(), 0, -3, 0); }},
      {"rod_hole_elsewhere", [] { return with_moved_loop(rod_hole(), 0, 0.5, 0); }},
      {"rod_holes_one_off",
       [] {
         return with_moved_loop(rod_with_holes({{1.6, 50}, {3, 30}, {5, 70}}), 1, 1, 0);
       }},
      {"rod_outer_off", [] { return with_moved_loop(rod_hole(), -1, 1, 0); }},
      {"rod_hole_reversed", [] { return with_moved_loop(rod_hole(), 0, 1, 0).Reversed(); }},
      {"rod_hole_spline", [] { return with_moved_loop(as_closed_spline(rod_hole(), true), 0, 1, 0); }},
      {"rod_hole_closed", [] { return with_moved_loop(as_closed_spline(rod_hole(), false), 0, -1, 0); }},
      {"rod_all_beyond", [] { return with_moved_loop(as_closed_spline(rod_hole(), false), -2, 1, 0); }},
      {"rod_hole_nearly_closed", [] { return with_moved_loop(as_nearly_closed_spline(rod_hole()), 0, 1, 0, true); }},
      {"rod_hole_no_seam", [] { return without_seam(rod_hole()); }},
      {"rod_hole_no_seam_p1", [] { return without_seam(with_moved_loop(rod_hole(), 0, 1, 0)); }},
      {"stray_hole", stray_hole},
      {"rim_hole", rim_hole},
      {"box_stray_hole", [] { return box_with_stray_hole(false); }},
      {"box_stray_tube", [] { return box_with_stray_hole(true); }},
      {"turned_hole", [] { return drilled_box_turned(false); }},
      {"turned_outer", [] { return drilled_box_turned(true); }},
      {"torus_hole", torus_hole},
      {"torus_hole_off", [] { return with_moved_loop(torus_hole(), 0, 1, -1); }},
  };
}

}  // namespace

std::vector<std::string> damaged_shapes() {
  std::vector<std::string> names;
  for (const auto& [name, maker] : makers()) names.push_back(name);
  return names;
}

void write_damaged(const std::string& name, const std::string& path) {
  const Makers all = makers();
  const auto maker = all.find(name);
  if (maker == all.end()) throw std::runtime_error("no damaged shape " + name);
  if (!BRepTools::Write(maker->second(), path.c_str())) throw std::runtime_error("cannot write " + path);
}

}  // namespace st::test
