#include "broken/broken_shapes.h"

#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_Copy.hxx>
#include <BRepBuilderAPI_GTransform.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_BezierCurve.hxx>
#include <Geom2d_Line.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_Circle.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Line.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <functional>
#include <gp_Pln.hxx>
#include <map>
#include <stdexcept>
#include <vector>

namespace st::test {
namespace {

TopoDS_Shape compound(const std::vector<TopoDS_Shape>& parts) {
  BRep_Builder builder;
  TopoDS_Compound result;
  builder.MakeCompound(result);
  for (const TopoDS_Shape& part : parts) builder.Add(result, part);
  return result;
}

TopoDS_Shape box(double x, double y, double z) { return BRepPrimAPI_MakeBox(x, y, z).Shape(); }
TopoDS_Shape centred_cube(double side) {
  return BRepPrimAPI_MakeBox(gp_Pnt(-side / 2, -side / 2, -side / 2), side, side, side).Shape();
}
TopoDS_Shape shell_of(const TopoDS_Shape& solid) { return TopExp_Explorer(solid, TopAbs_SHELL).Current(); }

std::vector<TopoDS_Shape> loose_faces_of(const TopoDS_Shape& solid) {
  std::vector<TopoDS_Shape> faces;
  for (TopExp_Explorer f(solid, TopAbs_FACE); f.More(); f.Next())
    faces.push_back(BRepBuilderAPI_Copy(f.Current()).Shape());
  return faces;
}

TopoDS_Shape doubled_face() {
  std::vector<TopoDS_Shape> faces = loose_faces_of(box(60, 40, 20));
  faces.push_back(BRepBuilderAPI_Copy(faces[2]).Shape());
  return compound(faces);
}

TopoDS_Shape sheet_on_solid() {
  const TopoDS_Shape solid = box(60, 40, 20);
  const std::vector<TopoDS_Shape> faces = loose_faces_of(solid);
  return compound({faces[1], faces[4], solid});
}

/// Every face of the box moved along its diagonal by a step of its own, up to 0.05.
TopoDS_Shape gappy_box() {
  std::vector<TopoDS_Shape> faces = loose_faces_of(box(60, 40, 20));
  for (std::size_t i = 0; i < faces.size(); ++i) {
    gp_Trsf step;
    step.SetTranslation(gp_Vec(0.01, 0.01, 0.01) * static_cast<double>(i));
    faces[i] = BRepBuilderAPI_Transform(faces[i], step, true).Shape();
  }
  return compound(faces);
}

TopoDS_Shape polygon_face(const std::vector<gp_Pnt>& points) {
  BRepBuilderAPI_MakePolygon polygon;
  for (const gp_Pnt& p : points) polygon.Add(p);
  polygon.Close();
  return BRepBuilderAPI_MakeFace(gp_Pln(gp::XOY()), polygon.Wire(), false).Shape();
}

/// Two triangles tip to tip, one loop that passes the tip twice.
TopoDS_Shape hourglass() {
  const auto vertex = [](double x, double y) { return BRepBuilderAPI_MakeVertex(gp_Pnt(x, y, 0)).Vertex(); };
  const TopoDS_Vertex tip = vertex(0, 0), a = vertex(10, 10), b = vertex(-10, 10), c = vertex(-10, -10),
                      d = vertex(10, -10);
  const std::vector<TopoDS_Vertex> loop{a, b, tip, c, d, tip};
  TopoDS_Wire wire;
  BRep_Builder().MakeWire(wire);
  for (std::size_t k = 0; k < loop.size(); ++k)
    BRep_Builder().Add(wire, BRepBuilderAPI_MakeEdge(loop[k], loop[(k + 1) % loop.size()]).Edge());
  return BRepBuilderAPI_MakeFace(gp_Pln(gp::XOY()), wire, false).Shape();
}

TopoDS_Shape off_pcurve() {
  TColgp_Array2OfPnt poles(1, 4, 1, 4);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) poles(i + 1, j + 1) = gp_Pnt(10 * i, 10 * j, (i * j) % 3);
  const Handle(Geom_BezierSurface) surface = new Geom_BezierSurface(poles);
  const TopoDS_Face face = BRepBuilderAPI_MakeFace(surface, 0, 1, 0, 1, 1e-7).Face();
  BRep_Builder builder;
  for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
    double t0, t1;
    const TopoDS_Edge edge = TopoDS::Edge(e.Current());
    const Handle(Geom2d_Curve) old = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
    const gp_Pnt2d a = old->Value(t0), b = old->Value(t1);
    if (std::abs(a.Y()) > 1e-9 || std::abs(b.Y()) > 1e-9) continue;
    TColgp_Array1OfPnt2d bulge(1, 3);
    bulge(1) = a;
    bulge(2) = gp_Pnt2d(0.5, 0.03);
    bulge(3) = b;
    builder.UpdateEdge(edge, new Geom2d_BezierCurve(bulge), face, 1e-7);
    builder.SameParameter(edge, true);
    break;
  }
  return face;
}

TopoDS_Shape pin_in_plate() {
  const gp_Ax2 axis(gp_Pnt(20, 20, -10), gp::DZ());
  const TopoDS_Shape plate = BRepAlgoAPI_Cut(box(40, 40, 10), BRepPrimAPI_MakeCylinder(axis, 5, 30).Shape()).Shape();
  return compound({TopExp_Explorer(plate, TopAbs_SOLID).Current(), BRepPrimAPI_MakeCylinder(axis, 5, 30).Shape()});
}

TopoDS_Shape folded_sliver() {
  return compound({polygon_face({{0, 0, 0}, {10, 0, 0}, {10, 4, 0}, {0, 4, 0}}),
                   polygon_face({{0, 0, 0}, {0.5, 0.5, 0}, {9.5, 0.5, 0}, {10, 0, 0}})});
}

TopoDS_Shape far_circle() {
  const TopoDS_Shape cylinder = BRepPrimAPI_MakeCylinder(10, 20).Shape();
  for (TopExp_Explorer e(cylinder, TopAbs_EDGE); e.More(); e.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(e.Current());
    double t0, t1;
    const Handle(Geom_Circle) circle = Handle(Geom_Circle)::DownCast(BRep_Tool::Curve(edge, t0, t1));
    if (circle.IsNull() || circle->Location().Z() < 10) continue;
    BRep_Builder().UpdateEdge(edge, Handle(Geom_Curve)::DownCast(circle->Translated(gp_Vec(0, 0, 30))), 1e-7);
    break;
  }
  return cylinder;
}

TopoDS_Shape wing_in_body() {
  return compound({BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(-10, 0, 0), gp::DX()), 2, 20).Shape(),
                   BRepPrimAPI_MakeBox(gp_Pnt(-2, -15, -0.25), 4, 30, 0.5).Shape(),
                   BRepPrimAPI_MakeBox(gp_Pnt(-0.5, -0.2, -0.5), 1, 0.4, 4).Shape()});
}

TopoDS_Shape stacked_boxes() {
  const TopoDS_Shape lower = box(60, 40, 20);
  TopExp_Explorer f(lower, TopAbs_FACE);
  for (int k = 0; k < 5; ++k) f.Next();  // the side z = 20
  return compound({lower, BRepPrimAPI_MakePrism(f.Current(), gp_Vec(0, 0, 10)).Shape()});
}

/// As a reader leaves it that found no edge between two vertices: one vertex in the middle, its tolerance reaching
/// both.
TopoDS_Shape parted_corner() {
  BRep_Builder builder;
  TopoDS_Vertex corner;
  builder.MakeVertex(corner, gp_Pnt(9.75, 9.75, 0), 0.4);
  TopoDS_Vertex others[3];
  for (int k = 0; k < 3; ++k) builder.MakeVertex(others[k], gp_Pnt(k == 1 ? 10 : 0, k == 2 ? 10 : 0, 0), 1e-7);
  const auto line = [](TopoDS_Vertex a, TopoDS_Vertex b, gp_Pnt from, gp_Dir along, double length) {
    return BRepBuilderAPI_MakeEdge(new Geom_Line(from, along), a, b, 0, length).Edge();
  };
  BRepBuilderAPI_MakeWire wire(line(others[0], others[1], {0, 0, 0}, {1, 0, 0}, 10));
  wire.Add(line(others[1], corner, {10, 0, 0}, {0, 1, 0}, 9.5));
  wire.Add(TopoDS::Edge(line(others[2], corner, {0, 10, 0}, {1, 0, 0}, 9.5).Reversed()));
  wire.Add(line(others[2], others[0], {0, 10, 0}, {0, -1, 0}, 10));
  return BRepBuilderAPI_MakeFace(gp_Pln(gp::XOY()), wire.Wire()).Shape();
}

/// A rectangle [0,10] x [y0,y1] whose side on y = 0 runs as x = 10 t^power.
TopoDS_Shape rectangle_with_side(double y, int power) {
  TColgp_Array1OfPnt poles(1, power + 1);
  for (int i = 0; i <= power; ++i) poles(i + 1) = gp_Pnt(i == power ? 10 : 0, 0, 0);
  TColStd_Array1OfReal knots(1, 2);
  TColStd_Array1OfInteger multiplicities(1, 2);
  knots(1) = 0, knots(2) = 1;
  multiplicities(1) = multiplicities(2) = power + 1;
  const TopoDS_Edge side = BRepBuilderAPI_MakeEdge(new Geom_BSplineCurve(poles, knots, multiplicities, power)).Edge();
  BRepBuilderAPI_MakeWire wire(side);
  for (const auto& [a, b] : {std::pair{gp_Pnt(10, 0, 0), gp_Pnt(10, y, 0)},
                             std::pair{gp_Pnt(10, y, 0), gp_Pnt(0, y, 0)}, std::pair{gp_Pnt(0, y, 0), gp_Pnt(0, 0, 0)}})
    wire.Add(BRepBuilderAPI_MakeEdge(a, b).Edge());
  return BRepBuilderAPI_MakeFace(gp_Pln(gp::XOY()), wire.Wire()).Shape();
}

/// Trimming curve of `edge` with its ends and a bulge of `by` in u.
Handle(Geom2d_Curve) bulged(const TopoDS_Edge& edge, const TopoDS_Face& face, double by) {
  double t0, t1;
  const Handle(Geom2d_Curve) old = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
  TColgp_Array1OfPnt2d poles(1, 3);
  poles(1) = old->Value(t0), poles(3) = old->Value(t1);
  poles(2) = gp_Pnt2d(0.5 * (poles(1).X() + poles(3).X()) + by, 0.5 * (poles(1).Y() + poles(3).Y()));
  TColStd_Array1OfReal knots(1, 2);
  TColStd_Array1OfInteger multiplicities(1, 2);
  knots(1) = t0, knots(2) = t1;
  multiplicities(1) = multiplicities(2) = 3;
  return new Geom2d_BSplineCurve(poles, knots, multiplicities, 2);
}

TopoDS_Shape off_meridian() {
  const TopoDS_Face face =
      BRepBuilderAPI_MakeFace(new Geom_SphericalSurface(gp_Ax3(), 10), -0.25 * M_PI, 0.25 * M_PI, 0, 0.5 * M_PI, 1e-7)
          .Face();
  for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
    double t0, t1;
    const TopoDS_Edge edge = TopoDS::Edge(e.Current());
    const Handle(Geom2d_Curve) old = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
    if (std::abs(old->Value(t0).X() - old->Value(t1).X()) > 1e-9) continue;
    BRep_Builder().UpdateEdge(edge, bulged(edge, face, 0.1), face, 1e-7);
  }
  return face;
}

/// A pin around z: radius 2, 10 long, its lower end rounded by a cubic from radius 0.8 at z = 0 to 2 at z = 1.2.
TopoDS_Shape pin() {
  TColgp_Array1OfPnt poles(1, 4);
  poles(1) = gp_Pnt(0.8, 0, 0), poles(2) = gp_Pnt(1.46, 0, 0), poles(3) = gp_Pnt(2, 0, 0.54),
  poles(4) = gp_Pnt(2, 0, 1.2);
  BRepBuilderAPI_MakeWire wire(BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 0), gp_Pnt(0.8, 0, 0)).Edge());
  wire.Add(BRepBuilderAPI_MakeEdge(new Geom_BezierCurve(poles)).Edge());
  for (const auto& [a, b] :
       {std::pair{gp_Pnt(2, 0, 1.2), gp_Pnt(2, 0, 10)}, std::pair{gp_Pnt(2, 0, 10), gp_Pnt(0, 0, 10)},
        std::pair{gp_Pnt(0, 0, 10), gp_Pnt(0, 0, 0)}})
    wire.Add(BRepBuilderAPI_MakeEdge(a, b).Edge());
  return BRepPrimAPI_MakeRevol(BRepBuilderAPI_MakeFace(wire.Wire()).Face(), gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)))
      .Shape();
}

TopoDS_Shape lost_fillet() {
  const TopoDS_Shape solid = pin();
  BRep_Builder builder;
  for (TopExp_Explorer f(solid, TopAbs_FACE); f.More(); f.Next()) {
    const TopoDS_Face face = TopoDS::Face(f.Current().Oriented(TopAbs_FORWARD));
    if (!BRep_Tool::Surface(face)->IsKind(STANDARD_TYPE(Geom_SurfaceOfRevolution))) continue;
    for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
      double t0, t1;
      const TopoDS_Edge edge = TopoDS::Edge(e.Current());
      if (BRep_Tool::IsClosed(edge, face)) continue;
      const Handle(Geom2d_Curve) old = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
      builder.UpdateEdge(edge, Handle(Geom2d_Curve)::DownCast(old->Translated(gp_Vec2d(3.14, 0))), face, 1e-7);
    }
    for (TopExp_Explorer v(face, TopAbs_VERTEX); v.More(); v.Next())
      builder.UpdateVertex(TopoDS::Vertex(v.Current()), 1.0);
  }
  return solid;
}

TopoDS_Shape edges_elsewhere() {
  const Handle(Geom_Surface) cylinder = new Geom_CylindricalSurface(gp_Ax3(), 2);
  const TopoDS_Face face = BRepBuilderAPI_MakeFace(cylinder, 0, 2 * M_PI, 0, 5, 1e-7).Face();
  BRep_Builder builder;
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(face, TopAbs_EDGE, edges);
  for (int i = 1; i <= edges.Extent(); ++i) {
    const TopoDS_Edge edge = TopoDS::Edge(edges(i));
    double t0, t1;
    const Handle(Geom_Curve) old = BRep_Tool::Curve(edge, t0, t1);
    builder.UpdateEdge(edge, Handle(Geom_Curve)::DownCast(old->Translated(gp_Vec(20, 0, 0))), 1e-7);
  }
  return face;
}

TopoDS_Shape bare_sphere() {
  TopoDS_Face face;
  BRep_Builder().MakeFace(face, new Geom_SphericalSurface(gp_Ax3(), 10), 1e-7);
  return face;
}

TopoDS_Shape ring() {
  TopoDS_Face face;
  BRep_Builder builder;
  const Handle(Geom_ToroidalSurface) torus = new Geom_ToroidalSurface(gp_Ax3(), 10, 2);
  builder.MakeFace(face, torus, 1e-7);
  const TopoDS_Edge circle = BRepBuilderAPI_MakeEdge(torus->UIso(0)).Edge();
  builder.UpdateEdge(circle, new Geom2d_Line(gp_Pnt2d(0, 0), gp_Dir2d(0, 1)), face, 1e-7);
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  builder.Add(wire, circle);
  builder.Add(wire, circle.Reversed());
  builder.Add(face, wire);
  return face;
}

/// 6 x 2 x 1.2 about the origin.
TopoDS_Shape pod() {
  gp_GTrsf stretch;
  stretch.SetVectorialPart(gp_Mat(3, 0, 0, 0, 1, 0, 0, 0, 0.6));
  return BRepBuilderAPI_GTransform(BRepPrimAPI_MakeSphere(1).Shape(), stretch, true).Shape();
}

/// With a half width or radius of `r` about the origin.
TopoDS_Shape domain(const std::string& kind, double r) {
  const gp_Ax2 across(gp_Pnt(0, 0, -r), gp::DZ()), along(gp_Pnt(-r, 0, 0), gp::DX());
  const TopoDS_Shape whole = BRepPrimAPI_MakeBox(gp_Pnt(-r, -r, -r), 2 * r, 2 * r, 2 * r).Shape();
  if (kind == "sphere") return BRepPrimAPI_MakeSphere(r).Shape();
  if (kind == "cylinder") return BRepPrimAPI_MakeCylinder(along, r, 2 * r).Shape();
  if (kind == "c")
    return BRepAlgoAPI_Fuse(BRepPrimAPI_MakeCylinder(across, r, 2 * r).Shape(),
                            BRepPrimAPI_MakeBox(gp_Pnt(0, -r, -r), 2 * r, 2 * r, 2 * r).Shape())
        .Shape();
  return whole;
}

/// The air above z = 0 in a domain, without half a body of analytic faces: a capsule 6 long and 2 wide, or a cone and
/// cylinder of the same size with a flat base.
TopoDS_Shape turned_half(const std::string& kind, double r, bool is_capsule) {
  const TopoDS_Shape half =
      BRepAlgoAPI_Common(domain(kind, r), BRepPrimAPI_MakeBox(gp_Pnt(-2 * r, -2 * r, 0), 4 * r, 4 * r, 4 * r).Shape())
          .Shape();
  const auto along = [](double x) { return gp_Ax2(gp_Pnt(x, 0, 0), gp::DX()); };
  TopoDS_Shape body = BRepPrimAPI_MakeCylinder(along(-2), 1, is_capsule ? 4 : 5).Shape();
  if (is_capsule) {
    for (const double x : {-2., 2.}) body = BRepAlgoAPI_Fuse(body, BRepPrimAPI_MakeSphere(along(x), 1).Shape()).Shape();
  } else {
    body = BRepAlgoAPI_Fuse(body, BRepPrimAPI_MakeCone(along(-3), 0, 1, 1).Shape()).Shape();
  }
  return BRepAlgoAPI_Cut(half, body).Shape();
}

TopoDS_Shape pod_in(const std::string& kind, double r, bool is_half) {
  TopoDS_Shape outer = domain(kind, r);
  if (is_half)
    outer =
        BRepAlgoAPI_Common(outer, BRepPrimAPI_MakeBox(gp_Pnt(-2 * r, -2 * r, 0), 4 * r, 4 * r, 4 * r).Shape()).Shape();
  return BRepAlgoAPI_Cut(outer, pod()).Shape();
}

using Factories = std::map<std::string, std::function<TopoDS_Shape()>>;

void add_domains(Factories& all) {
  for (const char* kind : {"box", "sphere", "cylinder", "c"})
    for (const int size : {5, 50, 1000})
      for (const bool is_capsule : {false, true})
        all[std::string(is_capsule ? "capsule" : "cone") + "_in_" + kind + "_" + std::to_string(size)] = [=] {
          return turned_half(kind, 3.0 * size, is_capsule);
        };
  for (const char* kind : {"box", "sphere", "cylinder", "c"})
    for (const int size : {5, 50, 1000})
      for (const bool is_half : {false, true})
        all[std::string("pod_in_") + kind + "_" + std::to_string(size) + (is_half ? "_half" : "")] = [=] {
          return pod_in(kind, 3.0 * size, is_half);
        };
}

/// The loop (t^2 - 1, t^3 - t), which meets itself at t = -1 and 1, between two t; 10 high.
TopoDS_Shape looped_sheet(double a, double b) {
  TColgp_Array2OfPnt poles(1, 4, 1, 2);
  const double t[4][3] = {{a, a, a}, {a, a, b}, {a, b, b}, {b, b, b}};
  for (int i = 0; i < 4; ++i) {
    const auto& [r, s, q] = t[i];
    const double x = (r * s + s * q + q * r) / 3 - 1, y = r * s * q - (r + s + q) / 3;
    poles(i + 1, 1) = gp_Pnt(x, y, 0);
    poles(i + 1, 2) = gp_Pnt(x, y, 10);
  }
  return BRepBuilderAPI_MakeFace(new Geom_BezierSurface(poles), 1e-7).Shape();
}

/// Bodies that touch, cross, or hold others, and machine parts.
void add_bodies(Factories& all) {
  const Factories bodies{
      {"offset_boxes",
       [] {
         return compound({box(10, 10, 10), BRepPrimAPI_MakeBox(gp_Pnt(10, 3, 2), 10, 4, 5).Shape()});
       }},
      {"pin_in_plate", pin_in_plate},
      {"boxes_along_edge",
       [] {
         return compound({box(10, 10, 10), BRepPrimAPI_MakeBox(gp_Pnt(10, 10, 0), 10, 10, 10).Shape()});
       }},
      {"box_twice",
       [] {
         return compound({box(10, 10, 10), BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), 10, 10, 10).Shape()});
       }},
      {"crossing_boxes",
       [] {
         return compound({box(10, 10, 10), BRepPrimAPI_MakeBox(gp_Pnt(5, 5, 5), 10, 10, 10).Shape()});
       }},
      {"pinched_block",
       [] {
         const TopoDS_Shape outline = polygon_face(
             {{0, 0, 0}, {30, 0, 0}, {30, 20, 0}, {15, 20, 0}, {20, 10, 0}, {10, 10, 0}, {15, 20, 0}, {0, 20, 0}});
         return BRepPrimAPI_MakePrism(outline, gp_Vec(0, 0, 10)).Shape();
       }},
      {"looped_sheet", [] { return looped_sheet(-1.5, 1.5); }},
      {"open_loop", [] { return looped_sheet(-0.9, 1.5); }},
      {"swallow_tail",
       [] {
         return compound({looped_sheet(-1.5, 0), looped_sheet(0, 1.5)});
       }},
      {"folded_flap",
       [] {
         return compound({polygon_face({{0, 0, 0}, {10, 0, 0}, {10, 2, 0}, {0, 2, 0}}),
                          polygon_face({{0, 0, 0}, {1, 1, 0}, {9, 1, 0}, {10, 0, 0}})});
       }},
      {"folded_sliver", folded_sliver},
      {"far_circle", far_circle},
      {"wing_in_body", wing_in_body},
      {"spot",
       [] {
         const gp_Ax2 top(gp_Pnt(20, 20, 36), gp::DZ());
         return BRepAlgoAPI_Cut(box(40, 40, 40), BRepPrimAPI_MakeCone(top, 0, 5, 5).Shape()).Shape();
       }},
      {"blind_hole",
       [] {
         return BRepAlgoAPI_Cut(box(40, 40, 40),
                                BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(20, 20, 30), gp::DZ()), 4, 20).Shape())
             .Shape();
       }},
      {"housing", [] { return BRepAlgoAPI_Cut(centred_cube(40), centred_cube(30)).Shape(); }},
      {"moulded_block",
       [] { return BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(gp_Pnt(-5, -5, -2), 10, 10, 2).Shape(), pod()).Shape(); }},
      {"box_in_box",
       [] {
         return compound({centred_cube(60), centred_cube(10)});
       }},
  };
  all.insert(bodies.begin(), bodies.end());
}

Factories make_factories() {
  Factories all{
      {"doubled_face", doubled_face},
      {"sheet_on_solid", sheet_on_solid},
      {"gappy_box", gappy_box},
      {"touching_boxes",
       [] {
         return compound({box(10, 10, 10), BRepPrimAPI_MakeBox(gp_Pnt(10, 0, 0), 10, 10, 10).Shape()});
       }},
      {"touching_boxes_and_sheet",
       [] {
         return compound({box(10, 10, 10), BRepPrimAPI_MakeBox(gp_Pnt(10, 0, 0), 10, 10, 10).Shape(),
                          polygon_face({{50, 0, 0}, {60, 0, 0}, {60, 10, 0}})});
       }},
      {"inside_out", [] { return compound({box(60, 40, 20).Reversed()}); }},
      {"loose_shell", [] { return compound({shell_of(box(60, 40, 20)).Reversed()}); }},
      {"lone_sphere",
       [] { return compound({TopExp_Explorer(BRepPrimAPI_MakeSphere(10).Shape(), TopAbs_FACE).Current()}); }},
      {"nested_shells",
       [] {
         return compound({shell_of(centred_cube(40)), shell_of(centred_cube(60)), shell_of(centred_cube(20))});
       }},
      {"stacked_boxes", stacked_boxes},
      {"parted_corner", parted_corner},
      {"off_pcurve", off_pcurve},
      {"bow_tie",
       [] {
         return polygon_face({{0, 0, 0}, {10, 10, 0}, {10, 0, 0}, {0, 10, 0}});
       }},
      {"hourglass", hourglass},
      {"sliver",
       [] {
         return polygon_face({{0, 0, 0}, {100, 0, 0}, {100, 0.001, 0}, {0, 0.001, 0}});
       }},
      {"flat",
       [] {
         return polygon_face({{0, 0, 0}, {10, 0, 0}, {4, 0, 0}});
       }},
      {"short_edge",
       [] {
         return polygon_face({{0, 0, 0}, {10, 0, 0}, {10, 0.0001, 0}, {10, 10, 0}, {0, 10, 0}});
       }},
      {"off_meridian", off_meridian},
      {"lost_fillet", lost_fillet},
      {"edges_elsewhere", edges_elsewhere},
      {"bare_sphere", bare_sphere},
      {"ring", ring},
      {"speeds",
       [] {
         return compound({rectangle_with_side(5, 1), rectangle_with_side(-5, 3)});
       }},
  };
  add_domains(all);
  add_bodies(all);
  return all;
}

const Factories& factories() {
  static const Factories all = make_factories();
  return all;
}

}  // namespace

void write_broken(const std::string& name, const std::string& path) {
  const auto it = factories().find(name);
  if (it == factories().end()) throw std::runtime_error("no broken shape '" + name + "'");
  BRepTools::Write(it->second(), path.c_str());
}

}  // namespace st::test
