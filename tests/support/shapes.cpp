#include "support/shapes.h"
#include "geometry/import/import.h"

#include <stdlib.h>
#include <unistd.h>

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepAlgoAPI_BuilderAlgo.hxx>
#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepAlgoAPI_Splitter.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepOffsetAPI_MakePipeShell.hxx>
#include <BRepOffsetAPI_ThruSections.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <BinTools.hxx>
#include <GCPnts_AbscissaPoint.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <GC_MakeSegment.hxx>
#include <Geom2d_Curve.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <GeomAPI_ProjectPointOnCurve.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <GeomConvert.hxx>
#include <GeomFill.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_Circle.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Controller.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_LayerTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <stdexcept>

#include "geometry/brep/compound.h"

namespace st::test {
namespace {

const gp_Ax2 kZ(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1));

void require(bool ok, const std::string& what) {
  if (!ok) throw std::runtime_error("test shapes: " + what);
}

TopoDS_Shape box(double x, double y, double z) { return BRepPrimAPI_MakeBox(x, y, z).Shape(); }

TopoDS_Shape moved(const TopoDS_Shape& shape, double x, double y, double z) {
  gp_Trsf shift;
  shift.SetTranslation(gp_Vec(x, y, z));
  return shape.Moved(TopLoc_Location(shift));
}

TopoDS_Wire circle(double radius, bool reversed) {
  const TopoDS_Wire w = BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(gp_Circ(kZ, radius)).Edge()).Wire();
  return reversed ? TopoDS::Wire(w.Reversed()) : w;
}

TopoDS_Shape rectangle(double x, double y) { return BRepBuilderAPI_MakeFace(gp_Pln(gp::XOY()), 0, x, 0, y).Shape(); }

TopoDS_Shape disc() { return BRepBuilderAPI_MakeFace(gp_Pln(gp::XOY()), circle(10, false), true).Shape(); }

TopoDS_Shape annulus() {
  BRepBuilderAPI_MakeFace face(gp_Pln(gp::XOY()), circle(10, false), true);
  face.Add(circle(4, true));
  return face.Shape();
}

/// Between radii 9 and 10; its inner circles begin a quarter of the way around.
TopoDS_Shape turned_tube() {
  BRepBuilderAPI_MakeFace face(gp_Pln(gp::XOY()), circle(10, false), true);
  const gp_Circ inner(gp_Ax2(gp::Origin(), gp::DZ(), gp::DY()), 9);
  face.Add(TopoDS::Wire(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(inner).Edge()).Wire().Reversed()));
  return BRepPrimAPI_MakePrism(face.Face(), gp_Vec(0, 0, 5)).Shape();
}

TopoDS_Shape face_of(const Handle(Geom_Surface) & s) { return BRepBuilderAPI_MakeFace(s, 1e-7).Shape(); }

TopoDS_Shape face_of(const Handle(Geom_Surface) & s, double u0, double u1, double v0, double v1) {
  return BRepBuilderAPI_MakeFace(s, u0, u1, v0, v1, 1e-7).Shape();
}

/// The i-th face of a shape.
TopoDS_Shape nth_face(const TopoDS_Shape& s, int i) {
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(s, TopAbs_FACE, faces);
  return faces(i).Oriented(TopAbs_FORWARD);
}

/// Smooth heights that no formula of ours repeats.
double height(int i, int j) { return 1.5 * std::sin(0.9 * i + 0.3 * j) + std::cos(1.7 * j - 0.4 * i * i); }

TColgp_Array2OfPnt wave_poles(int nu, int nv, double x, double y) {
  TColgp_Array2OfPnt poles(1, nu, 1, nv);
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) poles(i + 1, j + 1) = gp_Pnt(x * i / (nu - 1), y * j / (nv - 1), height(i, j));
  return poles;
}

TColStd_Array2OfReal wave_weights(int nu, int nv) {
  TColStd_Array2OfReal w(1, nu, 1, nv);
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) w(i + 1, j + 1) = 1.0 + 0.5 * std::sin(2.1 * i + 1.3 * j);
  return w;
}

struct Knots {
  TColStd_Array1OfReal knots;
  TColStd_Array1OfInteger multiplicities;
};

/// Clamped knots at uneven places; `inner_multiplicity` of every inner one.
Knots clamped(int n_poles, int degree, double length, int inner_multiplicity = 1) {
  const int n_inner = (n_poles - degree - 1) / inner_multiplicity;
  Knots k{TColStd_Array1OfReal(1, n_inner + 2), TColStd_Array1OfInteger(1, n_inner + 2)};
  for (int i = 0; i <= n_inner + 1; ++i) {
    const double s = static_cast<double>(i) / (n_inner + 1);
    k.knots(i + 1) = length * (s + 0.3 * s * (1 - s));
    k.multiplicities(i + 1) = i == 0 || i == n_inner + 1 ? degree + 1 : inner_multiplicity;
  }
  return k;
}

/// Periodic knots, simple and uneven, starting at `first`.
Knots periodic(int n_poles, double first) {
  Knots k{TColStd_Array1OfReal(1, n_poles + 1), TColStd_Array1OfInteger(1, n_poles + 1)};
  for (int i = 0; i <= n_poles; ++i) {
    k.knots(i + 1) = first + i + (i > 0 && i < n_poles ? 0.25 * std::sin(i) : 0.0);
    k.multiplicities(i + 1) = 1;
  }
  return k;
}

Handle(Geom_BSplineSurface)
    wave(int nu, int nv, int degree_u, int degree_v, bool rational, int inner_multiplicity = 1) {
  const Knots u = clamped(nu, degree_u, 3, inner_multiplicity), v = clamped(nv, degree_v, 2);
  const TColgp_Array2OfPnt poles = wave_poles(nu, nv, 30, 20);
  if (rational)
    return new Geom_BSplineSurface(poles, wave_weights(nu, nv), u.knots, v.knots, u.multiplicities, v.multiplicities,
                                   degree_u, degree_v);
  return new Geom_BSplineSurface(poles, u.knots, v.knots, u.multiplicities, v.multiplicities, degree_u, degree_v);
}

/// A wave with kinks that the import leaves in their face: below 20 degrees.
Handle(Geom_BSplineSurface) gently_kinked() {
  const Handle(Geom_BSplineSurface) surface = wave(10, 6, 3, 2, false, 3);
  for (int i = 1; i <= surface->NbUPoles(); ++i)
    for (int j = 1; j <= surface->NbVPoles(); ++j) {
      const gp_Pnt p = surface->Pole(i, j);
      surface->SetPole(i, j, gp_Pnt(p.X(), p.Y(), 0.4 * p.Z()));
    }
  return surface;
}

/// A wave with one pole moved over its neighbours: it is folded there.
Handle(Geom_BSplineSurface) crumpled() {
  const Handle(Geom_BSplineSurface) surface = wave(10, 8, 3, 3, false);
  surface->SetPole(5, 4, surface->Pole(5, 4).Translated(gp_Vec(11, 0, 0)));
  return surface;
}

/// A wave, offset by more than its radii.
TopoDS_Shape folded_sheet() {
  return face_of(new Geom_OffsetSurface(wave(10, 8, 3, 3, false), 10), 0.1, 2.9, 0.1, 1.9);
}

/// A square; its right side runs 0.1 too far down in (u,v), within its tolerance, so that the loop runs back there.
TopoDS_Shape slipped_side() {
  const TopoDS_Face face = TopoDS::Face(rectangle(10, 10));
  BRep_Builder builder;
  for (TopExp_Explorer it(face, TopAbs_EDGE); it.More(); it.Next()) {
    const TopoDS_Edge side = TopoDS::Edge(it.Current());
    const BRepAdaptor_Curve line(side);
    if (line.Value(line.FirstParameter()).X() < 9 || line.Value(line.LastParameter()).X() < 9) continue;
    double first = 0, last = 0;
    const auto whole = Handle(Geom2d_Curve)::DownCast(BRep_Tool::CurveOnSurface(side, face, first, last)->Copy());
    whole->Translate(gp_Vec2d(0, -0.1));
    builder.UpdateEdge(side, whole, face, 0.11);
    for (const TopoDS_Vertex& v : {TopExp::FirstVertex(side), TopExp::LastVertex(side)}) builder.UpdateVertex(v, 0.11);
  }
  return face;
}

/// A box; the vertex at its highest corner lies off the ends of its three edges, within its tolerance.
TopoDS_Shape slipped_vertex(const gp_Vec& by) {
  const TopoDS_Shape shape = box(10, 10, 10);
  for (TopExp_Explorer it(shape, TopAbs_VERTEX); it.More(); it.Next()) {
    const TopoDS_Vertex vertex = TopoDS::Vertex(it.Current());
    const gp_Pnt p = BRep_Tool::Pnt(vertex);
    if (p.X() + p.Y() + p.Z() < 29) continue;
    BRep_Builder().UpdateVertex(vertex, p.Translated(by), 1.01 * by.Magnitude());
    break;
  }
  return shape;
}

/// A square, and on one of its edges a second face whose boundary crosses itself: it can only be closed in space.
TopoDS_Shape crossed_loop() {
  const gp_Pnt corner[] = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}, {0, -10, 0}, {10, -10, 0}};
  TopoDS_Vertex v[6];
  for (int i = 0; i < 6; ++i) v[i] = BRepBuilderAPI_MakeVertex(corner[i]);
  const auto line = [&](int a, int b) { return BRepBuilderAPI_MakeEdge(v[a], v[b]).Edge(); };
  const TopoDS_Edge common = line(0, 1);
  BRep_Builder builder;
  const auto face = [&](std::initializer_list<TopoDS_Edge> edges) {
    TopoDS_Wire wire;
    builder.MakeWire(wire);
    for (const TopoDS_Edge& e : edges) builder.Add(wire, e);
    wire.Closed(true);
    TopoDS_Face f;
    builder.MakeFace(f, new Geom_Plane(gp_Pln(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1))), 1e-7);
    builder.Add(f, wire);
    return f;
  };
  TopoDS_Shell shell;
  builder.MakeShell(shell);
  builder.Add(shell, face({common, line(1, 2), line(2, 3), line(3, 0)}));
  builder.Add(shell, face({common, line(1, 4), line(4, 5), line(5, 0)}));
  return shell;
}

/// A wavy tube about z, periodic along u.
Handle(Geom_BSplineSurface) periodic_tube() {
  constexpr int n = 9, m = 6;
  TColgp_Array2OfPnt poles(1, n, 1, m);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const double a = 2 * M_PI * i / n, r = 8 + 0.8 * std::sin(2 * a + j);
      poles(i + 1, j + 1) = gp_Pnt(r * std::cos(a), r * std::sin(a), 6.0 * j);
    }
  const Knots u = periodic(n, 0.7), v = clamped(m, 3, 2);
  return new Geom_BSplineSurface(poles, u.knots, v.knots, u.multiplicities, v.multiplicities, 3, 3, true, false);
}

/// The same tube with clamped knots: closed by its shape alone.
Handle(Geom_BSplineSurface) closed_tube() {
  const Handle(Geom_BSplineSurface) s = periodic_tube();
  s->SetUNotPeriodic();
  return s;
}

/// A plane sheet whose iso-lines along u lie a thousand times closer at one end.
Handle(Geom_BSplineSurface) stretched() {
  TColgp_Array2OfPnt poles(1, 5, 1, 4);
  const double x[] = {0, 0.02, 0.05, 5, 20};
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 4; ++j) poles(i + 1, j + 1) = gp_Pnt(x[i], 10.0 * j / 3, 0.05 * x[i] * std::sin(2.0 * j));
  const Knots u = clamped(5, 3, 1), v = clamped(4, 3, 1);
  return new Geom_BSplineSurface(poles, u.knots, v.knots, u.multiplicities, v.multiplicities, 3, 3);
}

Handle(Geom_BSplineCurve) wavy_curve() {
  TColgp_Array1OfPnt poles(1, 6);
  for (int i = 0; i < 6; ++i) poles(i + 1) = gp_Pnt(10 + 2 * std::sin(1.3 * i), 0, 5.0 * i);
  const Knots k = clamped(6, 3, 1);
  return new Geom_BSplineCurve(poles, k.knots, k.multiplicities, 3);
}

/// From the middle out.
TopoDS_Shape bore_along_x(double radius) {
  return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, 0), gp::DX()), radius, 20).Shape();
}

TopoDS_Shape ball_at(double x, double radius) { return BRepPrimAPI_MakeSphere(gp_Pnt(x, 0, 0), radius).Shape(); }

TopoDS_Shape drilled_cylinder() {
  const gp_Ax2 across(gp_Pnt(0, 0, 15), gp_Dir(1, 0, 0));
  return BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(10, 30).Shape(), BRepPrimAPI_MakeCylinder(across, 3, 20).Shape())
      .Shape();
}

TopoDS_Shape mirrored(const TopoDS_Shape& s) {
  gp_Trsf mirror;
  mirror.SetMirror(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(1, 0, 0)));
  return BRepBuilderAPI_Transform(s, mirror, true).Shape();
}

/// A copy of each face with edges of its own.
std::vector<TopoDS_Shape> loose_faces() {
  const double x = 60, y = 40, z = 20;
  const auto side = [](gp_Pnt o, gp_Dir n, gp_Dir along, double a, double b) -> TopoDS_Shape {
    return BRepBuilderAPI_MakeFace(gp_Pln(gp_Ax3(o, n, along)), 0, a, 0, b).Shape();
  };
  const gp_Dir px(1, 0, 0), py(0, 1, 0), pz(0, 0, 1);
  return {side({0, 0, 0}, px, py, y, z), side({x, 0, 0}, px, py, y, z), side({0, 0, 0}, py, pz, z, x),
          side({0, y, 0}, py, pz, z, x), side({0, 0, 0}, pz, px, x, y), side({0, 0, z}, pz, px, x, y)};
}

TopoDS_Shape spiked_plate() {
  BRepBuilderAPI_MakePolygon polygon;
  for (const gp_Pnt2d& p : {gp_Pnt2d(0, 0), gp_Pnt2d(10, -0.5), gp_Pnt2d(10, -6), gp_Pnt2d(16, -6), gp_Pnt2d(16, 6),
                            gp_Pnt2d(10, 6), gp_Pnt2d(10, 0.5)})
    polygon.Add(gp_Pnt(p.X(), p.Y(), 0));
  polygon.Close();
  return BRepBuilderAPI_MakeFace(polygon.Wire()).Shape();
}

/// A bar of 20 x 4 with a blunt edge along y = 4 whose width grows from 0.02 at x = 0 to 1 at x = 20.
TopoDS_Shape tapered_bar() {
  const auto section = [](double x, double width) {
    BRepBuilderAPI_MakePolygon polygon;
    for (const gp_Pnt& p : {gp_Pnt(x, 0, 0), gp_Pnt(x, 4, 0), gp_Pnt(x, 4, width), gp_Pnt(x, 0, 3)}) polygon.Add(p);
    polygon.Close();
    return polygon.Wire();
  };
  BRepOffsetAPI_ThruSections loft(true, true);
  loft.AddWire(section(0, 0.02));
  loft.AddWire(section(20, 1));
  loft.Build();
  return loft.Shape();
}

/// Three faces between helices of eight turns with a pitch of 3: radii 10 and 10.3 at one height, and one 0.3 above the
/// inner one.
TopoDS_Shape helical_ribbon() {
  const auto helix = [](double radius, double z) {
    constexpr int kTurns = 8, kPerTurn = 24;
    Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, kTurns * kPerTurn + 1);
    for (int i = 0; i <= kTurns * kPerTurn; ++i) {
      const double a = 2 * M_PI * i / kPerTurn;
      points->SetValue(i + 1, gp_Pnt(radius * std::cos(a), radius * std::sin(a), z + 3 * a / (2 * M_PI)));
    }
    GeomAPI_Interpolate through(points, false, 1e-9);
    through.Perform();
    return through.Curve();
  };
  const Handle(Geom_BSplineCurve) a = helix(10, 0), b = helix(10.3, 0), c = helix(10, 0.3);
  BRepBuilderAPI_Sewing sewing(1e-4);
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
    sewing.Add(BRepBuilderAPI_MakeFace(GeomFill::Surface(from, to), 1e-6).Shape());
  sewing.Perform();
  return sewing.SewedShape();
}

/// A disc of radius 60 with a pin of radius 2 and height 40 in its middle, round at its foot and its head.
TopoDS_Shape disc_with_pin() {
  const auto p = [](double r, double z) { return gp_Pnt(r, 0, z); };
  BRepBuilderAPI_MakeWire wire;
  const auto line = [&](const gp_Pnt& from, const gp_Pnt& to) { wire.Add(BRepBuilderAPI_MakeEdge(from, to)); };
  const double bend = std::sqrt(0.5);
  line(p(0, 0), p(60, 0));
  line(p(60, 0), p(60, 5));
  line(p(60, 5), p(3, 5));
  wire.Add(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(p(3, 5), p(3 - bend, 6 - bend), p(2, 6)).Value()));
  line(p(2, 6), p(2, 44));
  wire.Add(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(p(2, 44), p(1 + bend, 44 + bend), p(1, 45)).Value()));
  line(p(1, 45), p(0, 45));
  line(p(0, 45), p(0, 0));
  return BRepPrimAPI_MakeRevol(BRepBuilderAPI_MakeFace(wire.Wire()), gp::OZ()).Shape();
}

/// NACA 0012 of chord 10 in z = 0, nose at the origin, from the upper end to the lower one; `closing`: its last
/// coefficient, 0.1036 ends in a point, 0.1015 is 0.0252 thick at the end.
Handle(Geom_BSplineCurve) aerofoil(double closing, double thickness = 0.12) {
  constexpr int kHalf = 30;
  Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, 2 * kHalf + 1);
  for (int i = -kHalf; i <= kHalf; ++i) {
    const double x = std::pow(static_cast<double>(i) / kHalf, 2);
    const double y =
        5 * thickness * (0.2969 * std::sqrt(x) + x * (-0.126 + x * (-0.3516 + x * (0.2843 - closing * x))));
    points->SetValue(i + kHalf + 1, gp_Pnt(10 * x, i < 0 ? 10 * y : -10 * y, 0));
  }
  GeomAPI_Interpolate curve(points, false, 1e-9);
  curve.Perform();
  return curve.Curve();
}

/// A wing of chord 10 (x) and span 30 (z), if not swept.
TopoDS_Shape wing(double closing, double thickness = 0.12, gp_Vec along = gp_Vec(0, 0, 30)) {
  const Handle(Geom_BSplineCurve) curve = aerofoil(closing, thickness);
  const double nose = GeomAPI_ProjectPointOnCurve(gp_Pnt(0, 0, 0), curve).LowerDistanceParameter();
  const TopoDS_Edge upper = BRepBuilderAPI_MakeEdge(curve, curve->FirstParameter(), nose);
  const TopoDS_Edge lower = BRepBuilderAPI_MakeEdge(curve, nose, curve->LastParameter());
  BRepBuilderAPI_MakeWire wire(upper, lower);
  const double end = closing > 0.103 ? 0 : 6 * (0.2969 - 0.126 - 0.3516 + 0.2843 - closing);
  if (end > 0) wire.Add(BRepBuilderAPI_MakeEdge(gp_Pnt(10, end, 0), gp_Pnt(10, -end, 0)));
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire(), true).Face(), along).Shape();
}

/// The blunt wing, the long edges of its base cut into four and two.
TopoDS_Shape wing_with_cut_base() {
  const double y = 6 * (0.2969 - 0.126 - 0.3516 + 0.2843 - 0.1015);
  TopTools_ListOfShape arguments, tools;
  arguments.Append(wing(0.1015));
  for (const auto& [side, z] : {std::pair{1.0, 7.0}, {1.0, 7.0003}, {1.0, 19.0}, {-1.0, 12.0}})
    tools.Append(BRepBuilderAPI_MakeVertex(gp_Pnt(10, side * y, z)).Vertex());
  BRepAlgoAPI_Splitter splitter;
  splitter.SetArguments(arguments);
  splitter.SetTools(tools);
  splitter.Build();
  return splitter.Shape();
}

/// Length 30 (z) of one closed spline of length 10 (x), alike above and below, that begins above its middle. `narrow`:
/// how much thinner it is at one end than at the other; 0: an oval.
TopoDS_Shape closed_bar(double narrow) {
  constexpr int kPoints = 40;
  Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, kPoints);
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2 * M_PI * (i + 0.25 * kPoints) / kPoints, x = std::cos(angle);
    points->SetValue(i + 1, gp_Pnt(5 * x, (1 - narrow * x) * std::sin(angle), 0));
  }
  GeomAPI_Interpolate fit(points, true, 1e-9);
  fit.Perform();
  const TopoDS_Wire wire = BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(fit.Curve()).Edge()).Wire();
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire, true).Face(), gp_Vec(0, 0, 30)).Shape();
}

/// Of chord 60, 50, 10 and 6 at z = 0, 6, 12 and 30, its trailing edge along x = 10.
TopoDS_Shape tapering_wing() {
  BRepOffsetAPI_ThruSections loft(true, true);
  for (const auto& [z, share] : {std::pair{0.0, 6.0}, {6.0, 5.0}, {12.0, 1.0}, {30.0, 0.6}}) {
    gp_Trsf scaling, shift;
    scaling.SetScale(gp_Pnt(10, 0, 0), share);
    shift.SetTranslation(gp_Vec(0, 0, z));
    loft.AddWire(
        TopoDS::Wire(BRepBuilderAPI_Transform(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(aerofoil(0.1036))).Wire(),
                                              shift * scaling)
                         .Shape()));
  }
  loft.CheckCompatibility(false);
  return loft.Shape();
}

/// Of chord 8 and 4 at z = 0 and 15, its trailing edge along x = 10 up to y = 4, its root in a cylinder along x.
TopoDS_Shape canard_on_body() {
  BRepOffsetAPI_ThruSections loft(true, true);
  for (const auto& [z, share] : {std::pair{0.0, 0.8}, {15.0, 0.4}}) {
    gp_Trsf scaling, shift;
    scaling.SetScale(gp_Pnt(10, 0, 0), share);
    shift.SetTranslation(gp_Vec(0, 4 * z / 15, z));
    loft.AddWire(TopoDS::Wire(
        BRepBuilderAPI_Transform(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(aerofoil(0.1036, 0.08))).Wire(),
                                 shift * scaling)
            .Shape()));
  }
  loft.CheckCompatibility(false);
  const gp_Ax2 axis(gp_Pnt(-15, 0, 0), gp_Dir(1, 0, 0));
  return BRepAlgoAPI_Fuse(loft.Shape(), BRepPrimAPI_MakeCylinder(axis, 4, 55).Shape()).Shape();
}

/// The sharp wing, on a third of its span two horns of ice around its nose.
TopoDS_Shape iced_wing() {
  BRepBuilderAPI_MakePolygon outline;
  for (const auto& [x, y] :
       {std::pair{0.2, 0.2}, {-0.2, 0.45}, {-0.25, 0.4}, {-0.12, 0.0}, {-0.25, -0.35}, {-0.2, -0.4}, {0.2, -0.2}})
    outline.Add(gp_Pnt(x, y, 10));
  outline.Close();
  const TopoDS_Face face = BRepBuilderAPI_MakeFace(outline.Wire(), true).Face();
  return BRepAlgoAPI_Fuse(wing(0.1036), BRepPrimAPI_MakePrism(face, gp_Vec(0, 0, 10)).Shape()).Shape();
}

/// On a plate, 6 long; one end is a ramp of 20 degrees.
TopoDS_Shape block_with_ramp(double width) {
  BRepBuilderAPI_MakePolygon side(gp_Pnt(3, 1, 1), gp_Pnt(9, 1, 1), gp_Pnt(9, 1, 2), gp_Pnt(5.75, 1, 2), true);
  const TopoDS_Face face = BRepBuilderAPI_MakeFace(side.Wire(), true).Face();
  return BRepAlgoAPI_Fuse(box(20, 10, 1), BRepPrimAPI_MakePrism(face, gp_Vec(0, width, 0)).Shape()).Shape();
}

/// A wing of chord 10 and span 30 with a rhombus as profile, 0.8 thick.
TopoDS_Shape double_wedge() {
  BRepBuilderAPI_MakePolygon profile(gp_Pnt(0, 0, 0), gp_Pnt(5, -0.4, 0), gp_Pnt(10, 0, 0), gp_Pnt(5, 0.4, 0), true);
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(profile.Wire(), true).Face(), gp_Vec(0, 0, 30)).Shape();
}

/// A wing of span 30 and chord 10 whose front is flat: a profile without a nose.
TopoDS_Shape wedge_fin() {
  BRepBuilderAPI_MakePolygon profile(gp_Pnt(0, -0.8, 0), gp_Pnt(10, 0, 0), gp_Pnt(0, 0.8, 0), true);
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(profile.Wire(), true).Face(), gp_Vec(0, 0, 30)).Shape();
}

/// What two balls of radius 20 have in common, 2 thick: its rim is sharp all around.
TopoDS_Shape lens() {
  return BRepAlgoAPI_Common(moved(BRepPrimAPI_MakeSphere(20).Shape(), 0, 0, 19),
                            moved(BRepPrimAPI_MakeSphere(20).Shape(), 0, 0, -19))
      .Shape();
}

/// A sail of chord 10 and span 30 between two arcs, 0.2 thick and cambered: luff and leech are sharp, and the caps of
/// its ends so narrow that their rims look like blunt edges.
TopoDS_Shape thin_sail() {
  const gp_Pnt a(0, 0, 0), b(10, 0, 0);
  const TopoDS_Edge lower = BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(a, gp_Pnt(5, 0.8, 0), b).Value());
  const TopoDS_Edge upper = BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(a, gp_Pnt(5, 1, 0), b).Value());
  const TopoDS_Wire outline = BRepBuilderAPI_MakeWire(lower, upper).Wire();
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(outline).Face(), gp_Vec(0, 0, 30)).Shape();
}

/// The sharp wing, its root in a box that ends at z = 4.
TopoDS_Shape wing_on_body() { return BRepAlgoAPI_Fuse(wing(0.1036), moved(box(16, 4, 8), -3, -2, -4)).Shape(); }

/// The half of a wing above y = 0, which a plane of symmetry would close.
TopoDS_Shape half_wing(double closing) {
  return BRepAlgoAPI_Common(wing(closing), moved(box(14, 5, 34), -2, 0, -2)).Shape();
}

/// A wing whose noses all lie on one axis, around which it is revolved by a right angle.
TopoDS_Shape fan() {
  BRepBuilderAPI_MakeWire wire(BRepBuilderAPI_MakeEdge(aerofoil(0.1036)));
  const gp_Ax1 axis(gp_Pnt(-0.01, 0, 0), gp_Dir(0, 1, 0));
  return BRepPrimAPI_MakeRevol(BRepBuilderAPI_MakeFace(wire.Wire(), true).Face(), axis, 0.5 * M_PI).Shape();
}

/// Sharp wings around the x axis, a third of a turn from each other.
TopoDS_Shape three_blades() {
  std::vector<TopoDS_Shape> blades;
  for (int k = 0; k < 3; ++k) {
    gp_Trsf turn;
    turn.SetRotation(gp::OX(), 2 * M_PI / 3 * k);
    blades.push_back(BRepBuilderAPI_Transform(moved(wing(0.1036), 0, 0, 5), turn, true).Shape());
  }
  return occt::compound_of(blades);
}

/// The skin of the sharp wing without its tips, turned inside out.
TopoDS_Shape wing_skin() {
  BRepBuilderAPI_Sewing sewing(1e-6);
  for (TopExp_Explorer e(wing(0.1036), TopAbs_FACE); e.More(); e.Next())
    if (BRepAdaptor_Surface(TopoDS::Face(e.Current())).GetType() != GeomAbs_Plane) sewing.Add(e.Current());
  sewing.Perform();
  return sewing.SewedShape().Reversed();
}

/// The sharp wing with a pod 1 wide and 3.5 long below it, at mid-span.
TopoDS_Shape wing_with_pod() {
  const gp_Ax2 axis(gp_Pnt(2, -0.9, 15), gp_Dir(1, 0, 0));
  return BRepAlgoAPI_Fuse(wing(0.1036), BRepPrimAPI_MakeCylinder(axis, 0.5, 3.5).Shape()).Shape();
}

/// The sharp wing, its skin cut into n_chord x n_span faces, wide and narrow ones in turn. They join smoothly but at
/// the trailing edge.
TopoDS_Shape cut_prism(const Handle(Geom_Curve) & curve, int n_chord, int n_span, double height = 30) {
  const Handle(Geom_Surface) skin = new Geom_SurfaceOfLinearExtrusion(curve, gp_Dir(0, 0, 1));
  const auto cut = [](int i, int n) {  // between 0 and 1
    return (i % 2 && i < n ? i + 0.96 : i) / n;
  };
  const double u0 = curve->FirstParameter(), u1 = curve->LastParameter();
  const auto u = [&](int i) { return u0 + (u1 - u0) * cut(i, n_chord); };
  BRepBuilderAPI_Sewing sewing(1e-6);
  for (int i = 0; i < n_chord; ++i)
    for (int k = 0; k < n_span; ++k)
      sewing.Add(
          BRepBuilderAPI_MakeFace(skin, u(i), u(i + 1), height * cut(k, n_span), height * cut(k + 1, n_span), 1e-7)
              .Shape());
  for (const double z : {0.0, height}) {
    BRepBuilderAPI_MakeWire rim;
    for (int i = 0; i < n_chord; ++i)
      rim.Add(
          BRepBuilderAPI_MakeEdge(Handle(Geom_Curve)::DownCast(curve->Translated(gp_Vec(0, 0, z))), u(i), u(i + 1)));
    sewing.Add(BRepBuilderAPI_MakeFace(rim.Wire(), true).Shape());
  }
  sewing.Perform();
  return BRepBuilderAPI_MakeSolid(TopoDS::Shell(sewing.SewedShape())).Shape();
}

TopoDS_Shape cut_wing(int n_chord, int n_span) { return cut_prism(aerofoil(0.1036), n_chord, n_span); }

/// A round rod of two legs, its corner a part of a ball that is made by turning a circle about its diameter.
TopoDS_Shape bent_pipe() {
  BRepBuilderAPI_MakePolygon spine(gp_Pnt(0, 0, 0), gp_Pnt(0, 0, 10), gp_Pnt(8, 0, 10));
  BRepOffsetAPI_MakePipeShell pipe(spine.Wire());
  pipe.SetTransitionMode(BRepBuilderAPI_RoundCorner);
  pipe.Add(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(gp_Circ(kZ, 1))).Wire());
  pipe.Build();
  pipe.MakeSolid();
  return pipe.Shape();
}

/// A plano-convex lens 24 wide, beside the seam of its sphere.
TopoDS_Shape flat_lens(double radius) {
  const double depth = std::sqrt(radius * radius - 144);
  return BRepAlgoAPI_Common(BRepPrimAPI_MakeSphere(radius).Shape(),
                            moved(box(radius, 50, 50), -radius - depth, -25, -25))
      .Shape();
}

/// A long prism of a circle's segment: a flat side and an arched one, 0.1 apart at most, on two common edges of
/// length 40.
TopoDS_Shape shallow_prism() {
  const gp_Pnt a(-1, 0, 0), b(1, 0, 0);
  const TopoDS_Edge arc = BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(a, gp_Pnt(0, 0.1, 0), b).Value());
  BRepBuilderAPI_MakeWire wire(arc, BRepBuilderAPI_MakeEdge(b, a));
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire(), true).Face(), gp_Vec(0, 0, 40)).Shape();
}

/// A prism of a drop's outline: half a cylinder and two planes that meet smoothly there and in a knife edge.
TopoDS_Shape drop_prism() {
  const double radius = 5, tip = 16, x = radius * radius / tip, y = radius * std::sqrt(1 - x / tip);
  const gp_Pnt upper(x, y, 0), lower(x, -y, 0), end(tip, 0, 0);
  BRepBuilderAPI_MakeWire outline(
      BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(upper, gp_Pnt(-radius, 0, 0), lower).Value()),
      BRepBuilderAPI_MakeEdge(lower, end), BRepBuilderAPI_MakeEdge(end, upper));
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(outline.Wire(), true).Face(), gp_Vec(0, 0, 30)).Shape();
}

/// A part of a cylinder in three layers, the one in the middle 0.002 high, the upper one in two parts of its angle.
TopoDS_Shape banded_pie() {
  const auto pie = [](double z, double height, double from, double to) {
    const gp_Ax2 axes(gp_Pnt(0, 0, z), gp_Dir(0, 0, 1), gp_Dir(std::cos(from), std::sin(from), 0));
    return BRepPrimAPI_MakeCylinder(axes, 10, height, to - from).Shape();
  };
  const TopoDS_Shape lower = BRepAlgoAPI_Fuse(pie(0, 2, 0, 2.5), pie(2, 0.002, 0, 2.5)).Shape();
  const TopoDS_Shape upper = BRepAlgoAPI_Fuse(pie(2.002, 2, 0, 0.8), pie(2.002, 2, 0.8, 2.5)).Shape();
  return BRepAlgoAPI_Fuse(lower, upper).Shape();
}

/// A bar of 20 in layers along it: two whole thin ones, the upper one thicker, and one in two parts of the length.
TopoDS_Shape layered_bar() {
  const auto layer = [](double from, double to, double z, double height) {
    return BRepPrimAPI_MakeBox(gp_Pnt(from, 0, z), to - from, 5, height).Shape();
  };
  TopoDS_Shape bar = layer(0, 20, 0, 3);
  for (const TopoDS_Shape& next : {layer(0, 20, 3, 0.1), layer(0, 20, 3.1, 0.12), layer(0, 12, 3.22, 0.1),
                                   layer(12, 20, 3.22, 0.1), layer(0, 20, 3.32, 3)})
    bar = BRepAlgoAPI_Fuse(bar, next).Shape();
  return bar;
}

/// A passage of a compressor about x, of 40 degrees: its two sides are curved, one the image of the other.
TopoDS_Shape passage() {
  TColgp_Array2OfPnt poles(1, 3, 1, 3);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) poles.SetValue(i + 1, j + 1, gp_Pnt(15 * i, i == 1 ? 3 + j : 0, 20 + 5 * j));
  const gp_Ax1 x(gp_Pnt(0, 0, 0), gp_Dir(1, 0, 0));
  return BRepPrimAPI_MakeRevol(face_of(new Geom_BezierSurface(poles)), x, 40 * M_PI / 180).Shape();
}

/// Three faces on one edge.
TopoDS_Shape t_junction() {
  BRepBuilderAPI_Sewing sewing(1e-6, true, true, true, true);
  const gp_Dir z(0, 0, 1);
  for (double a : {0.0, 2.0, 4.0}) {
    const gp_Dir n(std::cos(a), std::sin(a), 0);
    sewing.Add(BRepBuilderAPI_MakeFace(gp_Pln(gp_Ax3(gp_Pnt(0, 0, 0), n, z)), 0, 10, 0, 5).Shape());
  }
  sewing.Perform();
  return sewing.SewedShape();
}

/// As a boolean operation leaves it: the sheet's rim is an edge INTERNAL to the floor.
TopoDS_Shape baffled_box() {
  const gp_Pln plane(gp_Ax3(gp_Pnt(5, 5, 0), gp_Dir(1, 0, 0), gp_Dir(0, 1, 0)));
  TopTools_ListOfShape parts;
  parts.Append(BRepPrimAPI_MakeBox(10, 10, 10).Shape());
  parts.Append(BRepBuilderAPI_MakeFace(plane, -2, 2, -4, 0).Shape());
  BRepAlgoAPI_BuilderAlgo builder;
  builder.SetArguments(parts);
  builder.Build();
  return builder.Shape();
}

/// That passes the seam of the ball twice, on one side by almost half of the way around.
TopoDS_Shape ball_with_bar() {
  const gp_Pnt foot(-2.4543, -1.5133, 1.175);
  const gp_Vec along(1.5845241334505813, -3.712081022202076, 2.681404475281247);
  const TopoDS_Shape bar =
      BRepPrimAPI_MakeCylinder(gp_Ax2(foot, gp_Dir(along)), 1.1316396335373533, along.Magnitude()).Shape();
  gp_Trsf turn;
  turn.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(0.6884847167200077, -0.176649811524064, 1)), 0.17866263909478408);
  const TopoDS_Shape ball = BRepPrimAPI_MakeSphere(gp_Pnt(-1.4032, -1.5479, 2.9329), 2.1378091136552104).Shape();
  return BRepAlgoAPI_Fuse(ball, BRepBuilderAPI_Transform(bar, turn, true).Shape()).Shape();
}

/// The body of revolution of a curve from tip to tip, about z.
TopoDS_Shape between_tips(const Handle(Geom_Curve) & curve) {
  const TopoDS_Edge side = BRepBuilderAPI_MakeEdge(curve);
  const TopoDS_Edge axis = BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 9), gp_Pnt(0, 0, -9));
  const TopoDS_Shape half = BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakeWire(side, axis).Wire()).Shape();
  return BRepPrimAPI_MakeRevol(half, gp::OZ()).Shape();
}

TopoDS_Shape spindle() {
  TColgp_Array1OfPnt poles(1, 3);
  poles.SetValue(1, gp_Pnt(0, 0, -9));
  poles.SetValue(2, gp_Pnt(6, 0, 0));
  poles.SetValue(3, gp_Pnt(0, 0, 9));
  return between_tips(new Geom_BezierCurve(poles));
}

/// Of an arc: the full circle that it is part of crosses the axis.
TopoDS_Shape lemon() {
  return between_tips(GC_MakeArcOfCircle(gp_Pnt(0, 0, -9), gp_Pnt(3, 0, 0), gp_Pnt(0, 0, 9)).Value());
}

/// With a box that stands across the seam of a body, or beside it.
TopoDS_Shape with_fin(const TopoDS_Shape& body, double y) {
  return BRepAlgoAPI_Fuse(body, moved(box(6, 1, 2), 0, y, -1)).Shape();
}

/// An eighth of a ball, in six pieces that meet at its pole.
TopoDS_Shape melon() {
  TopoDS_Shape all;
  for (int i = 0; i < 6; ++i) {
    const gp_Dir x(std::cos(i * M_PI / 12), std::sin(i * M_PI / 12), 0);
    const gp_Ax2 axes(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1), x);
    const TopoDS_Shape piece = BRepPrimAPI_MakeSphere(axes, 10, 0, M_PI / 2, M_PI / 12).Shape();
    all = i == 0 ? piece : BRepAlgoAPI_Fuse(all, piece).Shape();
  }
  return all;
}

/// Two smooth halves of a plate; a hole in one of them touches the other.
TopoDS_Shape plate_of_2_with_touching_hole() {
  const TopoDS_Shape plate = BRepAlgoAPI_Fuse(box(10, 10, 1), moved(box(5, 10, 1), -5, 0, 0)).Shape();
  const gp_Ax2 axis(gp_Pnt(2, 5, -1), gp_Dir(0, 0, 1), gp_Dir(-1, 0, 0));  // its seam is where it touches
  return BRepAlgoAPI_Cut(plate, BRepPrimAPI_MakeCylinder(axis, 2, 3).Shape()).Shape();
}

/// A bar that ends in a sliver of the same section: its long sides are strips, the sliver's are narrower ones.
TopoDS_Shape bar_with_sliver_end() {
  return BRepAlgoAPI_Fuse(box(10, 3, 0.5), moved(box(0.02, 3, 0.5), 10, 0, 0)).Shape();
}

/// Two bars, and between them the part of a plate that a hole leaves on one side: a crescent, whose ends are tangent to
/// the bars. Its two arcs are alike, but do not face each other.
TopoDS_Shape crescent_between_bars() {
  BRepBuilderAPI_MakePolygon rim;
  for (const gp_Pnt& p : {gp_Pnt(0, -4, 0), gp_Pnt(4.2, -4, 0), gp_Pnt(4.45, 0, 0), gp_Pnt(4.2, 4, 0), gp_Pnt(0, 4, 0)})
    rim.Add(p);
  rim.Close();
  const TopoDS_Shape plate = BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(rim.Wire()).Face(), gp_Vec(0, 0, 1)).Shape();
  TopoDS_Shape all =
      BRepAlgoAPI_Cut(plate, BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, -1), gp_Dir(0, 0, 1)), 4, 3).Shape()).Shape();
  for (const double y : {-5.0, 4.0}) all = BRepAlgoAPI_Fuse(all, moved(box(8.4, 1, 1), -4.2, y, 0)).Shape();
  return all;
}

/// A wing with a dent along its leading edge, where two faces meet: each has a nose of its own beside the edge, at the
/// same distance from the trailing edge. z is up.
TopoDS_Shape wing_with_dented_nose(bool is_lower_first) {
  BRepBuilderAPI_MakeWire section;
  for (const double side : {is_lower_first ? -1.0 : 1.0, is_lower_first ? 1.0 : -1.0}) {
    TColgp_Array1OfPnt poles(1, 4);
    poles.SetValue(1, gp_Pnt(0.03, 0, 0));
    poles.SetValue(2, gp_Pnt(-0.02, 0, 0.06 * side));
    poles.SetValue(3, gp_Pnt(0.3, 0, 0.1 * side));
    poles.SetValue(4, gp_Pnt(1, 0, 0));
    section.Add(BRepBuilderAPI_MakeEdge(new Geom_BezierCurve(poles)).Edge());
  }
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(section.Wire()).Face(), gp_Vec(0, 5, 0)).Shape();
}

/// The profile of a wing in two halves, ruled from the chord to either side: poles at both ends of the chord.
TopoDS_Shape tip_of_2() {
  BRepBuilderAPI_Sewing sewing(1e-6);
  for (const double y : {2.0, -1.0}) {
    const Handle(Geom_TrimmedCurve) side =
        GC_MakeArcOfCircle(gp_Pnt(0, 0, 0), gp_Pnt(5, y, 0), gp_Pnt(10, 0, 0)).Value();
    const Handle(Geom_TrimmedCurve) chord = GC_MakeSegment(gp_Pnt(0, 0, 0), gp_Pnt(10, 0, 0)).Value();
    TopoDS_Shape half = BRepBuilderAPI_MakeFace(GeomFill::Surface(chord, side), 1e-6).Face();
    sewing.Add(y < 0 ? half.Reversed() : half);
  }
  sewing.Perform();
  return sewing.SewedShape();
}

using Factory = std::function<TopoDS_Shape()>;

const std::map<std::string, Factory>& factories() {
  static const std::map<std::string, Factory> all{
      {"box", [] { return box(60, 40, 20); }},
      {"sphere", [] { return BRepPrimAPI_MakeSphere(10).Shape(); }},
      {"cylinder", [] { return BRepPrimAPI_MakeCylinder(10, 30).Shape(); }},
      {"cone", [] { return BRepPrimAPI_MakeCone(kZ, 10, 0, 20).Shape(); }},
      {"torus", [] { return BRepPrimAPI_MakeTorus(20, 6).Shape(); }},
      {"drilled_cylinder", drilled_cylinder},
      {"ball_with_stem",  // that meets the seam of the ball
       [] {
         const gp_Ax2 along_x(gp_Pnt(0, 0, 0), gp::DX());
         return BRepAlgoAPI_Fuse(BRepPrimAPI_MakeSphere(5), BRepPrimAPI_MakeCylinder(along_x, 1, 9)).Shape();
       }},
      {"ball_with_stem_and_cavity",
       [] {
         const TopoDS_Shape stem = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, 0), gp::DX()), 1, 7).Shape();
         const TopoDS_Shape pin = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, 0), gp::DY()), 0.8, 3).Shape();
         const TopoDS_Shape cavity = BRepAlgoAPI_Fuse(BRepPrimAPI_MakeSphere(2).Shape(), pin).Shape();
         return BRepAlgoAPI_Cut(BRepAlgoAPI_Fuse(BRepPrimAPI_MakeSphere(5).Shape(), stem), cavity).Shape();
       }},
      {"ball_with_bar", ball_with_bar},
      {"bent_pipe", bent_pipe},
      {"spindle_with_fin", [] { return with_fin(spindle(), -0.4); }},
      {"spindle_with_fin_beside", [] { return with_fin(spindle(), 0.4); }},
      {"lemon", lemon},
      {"lemon_with_fin", [] { return with_fin(lemon(), -0.4); }},
      {"lemon_with_fin_beside", [] { return with_fin(lemon(), 0.4); }},
      {"flat_lens", [] { return flat_lens(100); }},
      {"long_lens", [] { return flat_lens(5000); }},
      {"dimpled_cylinder",  // whose rim is sharp
       [] {
         return BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(2, 8).Shape(), BRepPrimAPI_MakeSphere(gp_Pnt(2.5, 0, 9.8), 4))
             .Shape();
       }},
      {"hollow_ball_with_stem",
       [] {
         const TopoDS_Shape stem = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, 0), gp::DX()), 1, 9).Shape();
         return BRepAlgoAPI_Cut(BRepAlgoAPI_Fuse(BRepPrimAPI_MakeSphere(5), stem).Shape(), BRepPrimAPI_MakeSphere(3))
             .Shape();
       }},
      {"ball_without_octant", [] { return BRepAlgoAPI_Cut(BRepPrimAPI_MakeSphere(5), box(10, 10, 10)).Shape(); }},
      {"ring_with_dimple_at_seam",
       [] {
         return BRepAlgoAPI_Cut(BRepPrimAPI_MakeTorus(10, 3).Shape(), BRepPrimAPI_MakeSphere(gp_Pnt(13, 0, 0), 2))
             .Shape();
       }},
      {"ball_with_socket", [] { return BRepAlgoAPI_Cut(BRepPrimAPI_MakeSphere(5), ball_at(6, 4)).Shape(); }},
      {"ball_with_socket_at_seam",
       [] { return BRepAlgoAPI_Cut(BRepPrimAPI_MakeSphere(5), BRepPrimAPI_MakeSphere(gp_Pnt(4.5, 0, 0), 2)).Shape(); }},
      {"ball_with_notch",  // whose side passes the pole, the seam beside it
       [] {
         const gp_Pnt side(9 * std::cos(0.3), 9 * std::sin(0.3), 0);
         const TopoDS_Shape ball = between_tips(GC_MakeArcOfCircle(gp_Pnt(0, 0, -9), side, gp_Pnt(0, 0, 9)).Value());
         return BRepAlgoAPI_Cut(ball, moved(box(20, 7, 15), 0, -3, 5)).Shape();
       }},
      {"ball_with_two_holes",  // of one bore, both across the seam
       [] {
         return BRepAlgoAPI_Cut(BRepPrimAPI_MakeSphere(8).Shape(),
                                moved(BRepPrimAPI_MakeCylinder(2, 30).Shape(), 3, 0, -15))
             .Shape();
       }},
      {"spline_ball_with_pit",  // a cone's, with its floor
       [] {
         const TopoDS_Shape ball = BRepBuilderAPI_NurbsConvert(BRepPrimAPI_MakeSphere(5).Shape()).Shape();
         return BRepAlgoAPI_Cut(ball, moved(BRepPrimAPI_MakeCone(2, 0.5, 8).Shape(), -1.5, 1, 1)).Shape();
       }},
      {"ball_with_bore", [] { return BRepAlgoAPI_Cut(BRepPrimAPI_MakeSphere(10), bore_along_x(2)).Shape(); }},
      {"ring_with_ball",
       [] {
         const TopoDS_Shape ball = BRepPrimAPI_MakeSphere(gp_Pnt(8, -0.5, -1.5), 2).Shape();
         return BRepAlgoAPI_Fuse(BRepPrimAPI_MakeTorus(7, 2.5).Shape(), ball).Shape();
       }},
      {"ring_with_notch",  // across its outer rim, where v begins
       [] { return BRepAlgoAPI_Cut(BRepPrimAPI_MakeTorus(20, 6).Shape(), moved(box(8, 10, 5), -4, -30, -3)).Shape(); }},
      {"ring_with_notch_at_seam",  // which one of its sides is on
       [] { return BRepAlgoAPI_Cut(BRepPrimAPI_MakeTorus(8, 3).Shape(), moved(box(4, 2, 6), 6, 0, 1)).Shape(); }},
      {"two_balls", [] { return BRepAlgoAPI_Fuse(BRepPrimAPI_MakeSphere(5), ball_at(6, 4)).Shape(); }},
      {"cone_on_cylinder",
       [] {
         const gp_Ax2 on(gp_Pnt(0, 0, 10), gp_Dir(0, 0, 1));
         return BRepAlgoAPI_Fuse(BRepPrimAPI_MakeCylinder(5, 10).Shape(), BRepPrimAPI_MakeCone(on, 5, 4.9, 10).Shape())
             .Shape();
       }},
      {"mirrored_cylinder", [] { return mirrored(drilled_cylinder()); }},
      {"thin_cylinder", [] { return BRepPrimAPI_MakeCylinder(0.05, 30).Shape(); }},
      {"stepped_box", [] { return BRepAlgoAPI_Fuse(box(10, 10, 5), moved(box(5, 10, 0.02), 0, 0, 5)).Shape(); }},
      {"fading_block", [] { return block_with_ramp(2); }},
      {"wide_ramp", [] { return block_with_ramp(8); }},
      {"ledge_in_hole",  // square, 0.02 wide, half way down
       [] {
         const TopoDS_Shape hole = BRepAlgoAPI_Cut(box(10, 10, 5), moved(box(4, 4, 7), 3, 3, -1)).Shape();
         return BRepAlgoAPI_Cut(hole, moved(box(4.04, 4.04, 3), 2.98, 2.98, 2.5)).Shape();
       }},
      {"square_pipe",  // walls of 0.02
       [] { return BRepAlgoAPI_Cut(box(10, 10, 20), moved(box(9.96, 9.96, 22), 0.02, 0.02, -1)).Shape(); }},
      {"thin_pipe",
       [] {
         return BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(10, 20).Shape(),
                                moved(BRepPrimAPI_MakeCylinder(9.95, 22).Shape(), 0, 0, -1))
             .Shape();
       }},
      {"thin_ball",
       [] {
         return BRepAlgoAPI_Cut(BRepPrimAPI_MakeSphere(10).Shape(),
                                BRepPrimAPI_MakeSphere(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(3, 5, 8)), 9.99).Shape())
             .Shape();
       }},
      {"pin_in_bore",
       [] {
         const gp_Ax2 turned(gp_Pnt(0, 0, -10), gp_Dir(0, 0, 1), gp_Dir(4, 3, 0));
         return BRepAlgoAPI_Fuse(
                    BRepAlgoAPI_Cut(moved(box(40, 40, 10), -20, -20, 0),
                                    BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, -1), gp_Dir(0, 0, 1)), 10, 12).Shape())
                        .Shape(),
                    BRepPrimAPI_MakeCylinder(turned, 9.99, 30).Shape())
             .Shape();
       }},
      {"rod_and_shallow_prism",
       [] {
         return occt::compound_of({BRepPrimAPI_MakeCylinder(0.05, 30).Shape(), moved(shallow_prism(), 40, 0, 0)});
       }},
      {"thin_pin_in_block",
       [] {
         const gp_Ax2 turned(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1), gp_Dir(4, 3, 0));
         return occt::compound_of(
             {BRepAlgoAPI_Cut(moved(box(4, 4, 30), -2, -2, 0), BRepPrimAPI_MakeCylinder(0.05, 30).Shape()).Shape(),
              BRepPrimAPI_MakeCylinder(turned, 0.05, 30).Shape()});
       }},
      {"spindle_torus", [] { return BRepPrimAPI_MakeTorus(3, 5).Shape(); }},
      {"thin_plate", [] { return box(10, 10, 0.02); }},
      {"notched_plate", [] { return BRepAlgoAPI_Cut(box(10, 10, 1), moved(box(2, 2, 2), 9, 4, -0.5)).Shape(); }},
      {"framed_plate", [] { return BRepAlgoAPI_Cut(box(10, 10, 3), moved(box(4, 4, 5), 3, 0.1, -1)).Shape(); }},
      {"spiked_plate", spiked_plate},
      {"wedge_strip", [] { return tapered_bar(); }},
      {"helical_ribbon", helical_ribbon},
      {"disc_with_pin", disc_with_pin},
      {"thin_crescent",
       [] {
         const auto circle = [](double x, double r) {
           return BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(gp_Circ(gp_Ax2(gp_Pnt(x, 0, 0), gp_Dir(0, 0, 1)), r)))
               .Wire();
         };
         BRepBuilderAPI_MakeFace face(gp_Pln(gp::XOY()), circle(0, 10), true);
         face.Add(TopoDS::Wire(circle(0.098, 9.9).Reversed()));
         return face.Shape();
       }},
      {"shallow_prism", shallow_prism},
      {"banded_pie", banded_pie},
      {"layered_bar", layered_bar},
      {"pie", [] { return BRepPrimAPI_MakeCylinder(10, 30, 40 * M_PI / 180).Shape(); }},
      {"pie_off_axis", [] { return moved(BRepPrimAPI_MakeCylinder(10, 30, 40 * M_PI / 180).Shape(), 1e5, 7e4, 0); }},
      {"passage", passage},
      {"slender_cone", [] { return BRepPrimAPI_MakeCone(kZ, 1, 0, 30).Shape(); }},
      {"sharp_wing", [] { return wing(0.1036); }},
      {"blunt_wing", [] { return wing(0.1015); }},
      {"thin_wing", [] { return wing(0.1036, 0.035); }},
      {"tapering_wing", tapering_wing},
      {"wing_with_cut_base", wing_with_cut_base},
      {"closed_wing", [] { return closed_bar(0.6); }},
      {"oval_bar", [] { return closed_bar(0); }},
      {"double_wedge", double_wedge},
      {"wedge_fin", wedge_fin},
      {"lens", lens},
      {"thin_sail", thin_sail},
      {"wing_with_pod", wing_with_pod},
      {"swept_wing", [] { return wing(0.1015, 0.12, gp_Vec(32, 0, 27)); }},
      {"far_swept_wing", [] { return wing(0.1036, 0.12, gp_Vec(60, 0, 27)); }},
      {"swept_wing_in_box",
       [] {
         const TopoDS_Shape front = moved(box(14, 10, 10), -30, 4, 23);
         return BRepAlgoAPI_Fuse(wing(0.1036, 0.12, gp_Vec(-22, 9, 27)), front).Shape();
       }},
      {"half_sharp_wing", [] { return half_wing(0.1036); }},
      {"half_blunt_wing", [] { return half_wing(0.1015); }},
      {"wing_on_body", wing_on_body},
      {"canard_on_body", canard_on_body},
      {"iced_wing", iced_wing},
      {"fan", fan},
      {"three_blades", three_blades},
      {"two_wings_in_line",
       [] {
         return occt::compound_of({moved(wing(0.1036), 0, 0, 5), moved(wing(0.1036), 0, 0, -35)});
       }},
      {"two_tapering_wings",
       [] {
         return occt::compound_of({tapering_wing(), moved(tapering_wing(), 0, 0, 200)});
       }},
      {"wing_skin", wing_skin},
      {"wing_of_2", [] { return cut_wing(2, 1); }},
      {"wing_of_8", [] { return cut_wing(4, 2); }},
      {"wing_of_200", [] { return cut_wing(10, 20); }},
      {"drop_prism", drop_prism},
      {"melon", melon},
      {"plate_of_2_with_touching_hole", plate_of_2_with_touching_hole},
      {"bar_with_sliver_end", bar_with_sliver_end},
      {"crescent_between_bars", crescent_between_bars},
      {"wing_with_dented_nose", [] { return wing_with_dented_nose(false); }},
      {"wing_with_dented_nose_lower_first", [] { return wing_with_dented_nose(true); }},
      {"tip_of_2", tip_of_2},
      {"cylinder_of_8", [] { return cut_prism(new Geom_Circle(kZ, 5), 8, 1); }},
      {"disc_of_16", [] { return cut_prism(new Geom_Circle(kZ, 5), 16, 1, 0.05); }},  // its rim: strips and short
                                                                                      // pieces
      {"wing_in_box", [] { return BRepAlgoAPI_Cut(moved(box(60, 60, 60), -20, -30, -15), wing(0.1036)).Shape(); }},
      {"drilled_block",
       [] {
         const gp_Ax2 axis(gp_Pnt(30, 20, -5), gp_Dir(0, 0, 1));
         return BRepAlgoAPI_Cut(box(60, 40, 20), BRepPrimAPI_MakeCylinder(axis, 4, 30).Shape()).Shape();
       }},
      {"two_boxes",
       [] {
         return occt::compound_of({box(10, 10, 10), moved(box(10, 10, 10), 30, 0, 0)});
       }},
      {"facing_wedges",  // two wedges whose ends are coplanar and whose boxes meet, 1.4 apart
       [] {
         const auto wedge = [](gp_Pnt a, gp_Pnt b, gp_Pnt c) {
           BRepBuilderAPI_MakePolygon outline(a, b, c, true);
           return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(outline.Wire(), true).Face(), gp_Vec(0, 0, 5)).Shape();
         };
         return occt::compound_of(
             {wedge({0, 0, 0}, {10, 0, 0}, {0, 10, 0}), wedge({12, 0, 0}, {12, 12, 0}, {0, 12, 0})});
       }},
      {"box_of_60", [] { return box(60, 60, 60); }},
      {"nested_boxes",
       [] {
         return occt::compound_of(
             {moved(box(10, 10, 10), 20, 20, 20), box(60, 60, 60), moved(box(10, 10, 10), 40, 40, 0)});
       }},
      {"square", [] { return rectangle(10, 10); }},
      {"slipped_side", slipped_side},
      {"vertex_back",
       [] {
         return slipped_vertex({-0.5, 0, 0});
       }},
      {"vertex_ahead",
       [] {
         return slipped_vertex({0.5, 0, 0});
       }},
      {"vertex_aside",
       [] {
         return slipped_vertex({-0.3, 0.3, 0.1});
       }},
      {"vertex_inside",
       [] {
         return slipped_vertex({-0.3, -0.3, -0.3});
       }},
      {"vertex_outside",
       [] {
         return slipped_vertex({0.3, 0.3, 0.3});
       }},
      {"disc", disc},
      {"annulus", annulus},
      {"turned_tube", turned_tube},
      {"strip", [] { return rectangle(100, 0.2); }},
      {"sharp_triangle",
       [] {
         BRepBuilderAPI_MakePolygon corners(gp_Pnt(0, 0, 0), gp_Pnt(20, 0, 0), gp_Pnt(20, 2, 0), true);
         return BRepBuilderAPI_MakeFace(corners.Wire(), true).Shape();
       }},
      {"l_face",
       [] {
         BRepBuilderAPI_MakePolygon corners;
         for (const gp_Pnt& p : {gp_Pnt(0, 0, 0), gp_Pnt(10, 0, 0), gp_Pnt(10, 4, 0), gp_Pnt(4, 4, 0), gp_Pnt(4, 10, 0),
                                 gp_Pnt(0, 10, 0)})
           corners.Add(p);
         corners.Close();
         return BRepBuilderAPI_MakeFace(corners.Wire(), true).Shape();
       }},
      {"plate_with_hole",
       [] {
         return BRepAlgoAPI_Cut(rectangle(60, 40), moved(BRepPrimAPI_MakeCylinder(8, 10).Shape(), 30, 20, -5)).Shape();
       }},
      {"cone_side", [] { return nth_face(BRepPrimAPI_MakeCone(kZ, 10, 0, 20).Shape(), 1); }},
      {"sphere_octant", [] { return nth_face(BRepPrimAPI_MakeSphere(kZ, 10, 0, M_PI / 2, M_PI / 2).Shape(), 1); }},
      {"wave", [] { return face_of(wave(10, 8, 3, 3, false)); }},
      {"rational_wave", [] { return face_of(wave(9, 7, 3, 2, true)); }},
      {"high_degree_wave", [] { return face_of(wave(13, 11, 9, 7, true)); }},
      {"kinked", [] { return face_of(gently_kinked()); }},
      {"crumpled", [] { return face_of(crumpled()); }},
      {"folded_sheet", folded_sheet},
      {"folded_sheet_and_pipe",
       [] {
         const TopoDS_Shape pipe = BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(1.5, 2.5).Shape(),
                                                   moved(BRepPrimAPI_MakeCylinder(1.48, 4).Shape(), 0, 0, -1))
                                       .Shape();
         return occt::compound_of({folded_sheet(), moved(pipe, 28, 0, 7.5)});
       }},
      {"crossed_loop", crossed_loop},
      {"two_crossed_loops",
       [] {
         return occt::compound_of({crossed_loop(), moved(crossed_loop(), 0, 0, 5)});
       }},
      {"bezier", [] { return face_of(new Geom_BezierSurface(wave_poles(5, 4, 30, 20))); }},
      {"rational_bezier", [] { return face_of(new Geom_BezierSurface(wave_poles(4, 5, 30, 20), wave_weights(4, 5))); }},
      {"stretched", [] { return face_of(stretched()); }},
      {"periodic_tube", [] { return face_of(periodic_tube()); }},
      {"closed_tube", [] { return face_of(closed_tube()); }},
      {"tube_window", [] { return face_of(periodic_tube(), 7.1, 12.3, 0.2, 1.9); }},
      {"rational_torus",
       [] { return face_of(GeomConvert::SurfaceToBSplineSurface(new Geom_ToroidalSurface(gp_Ax3(kZ), 20, 6))); }},
      {"thin_tube", [] { return nth_face(BRepPrimAPI_MakeCylinder(0.05, 30).Shape(), 1); }},
      {"revolution", [] { return face_of(new Geom_SurfaceOfRevolution(wavy_curve(), gp::OZ()), 0, 2.5, 0, 1); }},
      {"extrusion",
       [] { return face_of(new Geom_SurfaceOfLinearExtrusion(wavy_curve(), gp_Dir(0.2, 1, 0)), 0, 1, -2, 7); }},
      {"offset", [] { return face_of(new Geom_OffsetSurface(wave(6, 6, 3, 3, false), 0.25), 0.1, 2.9, 0.1, 1.9); }},
      {"loose_box", [] { return occt::compound_of(loose_faces()); }},
      {"wire", [] { return circle(10, false); }},
      {"t_junction", t_junction},
      {"baffled_box", baffled_box},
  };
  return all;
}

TopoDS_Shape make_shape(const std::string& name) {
  const auto it = factories().find(name);
  require(it != factories().end(), "no shape '" + name + "'");
  return it->second();
}

/// A temporary file name that is gone with the object.
struct TemporaryFile {
  std::string path;
  explicit TemporaryFile(const std::string& suffix) {
    std::string name = (std::filesystem::temp_directory_path() / "st_shape_XXXXXX").string() + suffix;
    const int file = mkstemps(name.data(), static_cast<int>(suffix.size()));
    require(file >= 0, "no temporary file");
    ::close(file);
    path = name;
  }
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
};

void be_quiet() { Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_PrinterOStream)); }

void name(const TDF_Label& label, const char* text) {
  TDataStd_Name::Set(label, TCollection_ExtendedString(text, true));
}

/// An XCAF document that is written and closed.
struct Document {
  Handle(TDocStd_Document) document;
  Handle(XCAFDoc_ShapeTool) shapes;
  Handle(XCAFDoc_ColorTool) colors;
  Handle(XCAFDoc_LayerTool) layers;

  Document() {
    be_quiet();
    STEPCAFControl_Controller::Init();
    XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document);
    shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
    colors = XCAFDoc_DocumentTool::ColorTool(document->Main());
    layers = XCAFDoc_DocumentTool::LayerTool(document->Main());
  }
  ~Document() { XCAFApp_Application::GetApplication()->Close(document); }

  void write(const std::string& path) {
    shapes->UpdateAssemblies();
    Interface_Static::SetIVal("write.stepcaf.subshapes.name", 1);
    STEPCAFControl_Writer writer;
    writer.SetNameMode(true);
    writer.SetColorMode(true);
    writer.SetLayerMode(true);
    require(writer.Transfer(document, STEPControl_AsIs) && writer.Write(path.c_str()) == IFSelect_RetDone,
            "cannot write " + path);
  }
};

template <class T>
Vec3 vec(const T& p) {
  return {p.X(), p.Y(), p.Z()};
}

}  // namespace

std::vector<std::string> all_shapes() {
  std::vector<std::string> names;
  for (const auto& [name, factory] : factories()) names.push_back(name);
  return names;
}

void write_brep(const std::string& shape, const std::string& path) {
  require(BRepTools::Write(make_shape(shape), path.c_str()), path);
}

void write_binary_brep(const std::string& shape, const std::string& path) {
  require(BinTools::Write(make_shape(shape), path.c_str()), path);
}

void write_step(const std::string& shape, const std::string& path, const std::string& unit) {
  be_quiet();
  STEPControl_Controller::Init();
  require(Interface_Static::SetCVal("write.step.unit", unit.c_str()), "unit " + unit);
  STEPControl_Writer writer;
  const bool ok = writer.Transfer(make_shape(shape), STEPControl_AsIs) == IFSelect_RetDone &&
                  writer.Write(path.c_str()) == IFSelect_RetDone;
  Interface_Static::SetCVal("write.step.unit", "MM");
  require(ok, "cannot write " + path);
}

void write_iges(const std::string& shape, const std::string& path) {
  be_quiet();
  IGESControl_Controller::Init();
  IGESControl_Writer writer("MM", 0);
  require(writer.AddShape(make_shape(shape)), "cannot transfer " + path);
  writer.ComputeModel();
  require(writer.Write(path.c_str()), "cannot write " + path);
}

void write_named_loose_box(const std::string& path) {
  Document d;
  const char* names[] = {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};
  const std::vector<TopoDS_Shape> faces = loose_faces();
  for (int i = 0; i < 6; ++i) name(d.shapes->AddShape(faces[i], false), names[i]);
  d.write(path);
}

void write_named_assembly(const std::string& path) {
  Document d;
  const TopoDS_Shape block = box(60, 40, 20), pin = BRepPrimAPI_MakeCylinder(4, 15).Shape();
  const TDF_Label assembly = d.shapes->NewShape(), block_label = d.shapes->AddShape(block, false),
                  pin_label = d.shapes->AddShape(pin, false);
  name(assembly, "assembly");
  name(block_label, "block");
  name(pin_label, "pin");
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(block, TopAbs_FACE, faces);
  const char* names[] = {"wing", "symmetry", "Far Field"};
  for (int i = 0; i < 3; ++i) name(d.shapes->AddSubShape(block_label, faces(i + 1)), names[i]);
  TDF_Label first;
  require(d.shapes->FindSubShape(block_label, faces(1), first), "no label");
  d.colors->SetColor(first, Quantity_Color(1, 0, 0, Quantity_TOC_RGB), XCAFDoc_ColorSurf);
  d.layers->SetLayer(first, "skin");
  const auto at = [](double x) {
    gp_Trsf place;
    place.SetTranslation(gp_Vec(x, 0, 0));
    return TopLoc_Location(place);
  };
  const TDF_Label rack = d.shapes->NewShape();
  name(rack, "rack");
  for (const double x : {0.0, 50.0}) d.shapes->AddComponent(rack, pin_label, at(x));
  d.shapes->AddComponent(assembly, block_label, at(0));
  d.shapes->AddComponent(assembly, rack, at(100));
  d.write(path);
}

ImportResult import_shape(const std::string& shape) {
  const TemporaryFile file(".brep");
  write_brep(shape, file.path);
  return import_model(file.path, {});
}

Model make_model(const std::string& shape) {
  ImportResult r = import_shape(shape);
  return Model(std::move(r.tables), std::move(r.brep));
}

namespace {

Model model_of(const TopoDS_Shape& shape) {
  const TemporaryFile file(".brep");
  require(BRepTools::Write(shape, file.path.c_str()), file.path);
  ImportResult r = import_model(file.path, {});
  return Model(std::move(r.tables), std::move(r.brep));
}

}  // namespace

Model make_row_of_cubes(int n) {
  TopoDS_Compound row;
  BRep_Builder builder;
  builder.MakeCompound(row);
  for (int i = 0; i < n; ++i) builder.Add(row, BRepPrimAPI_MakeBox(gp_Pnt(2 * i, 0, 0), 1, 1, 1).Shape());
  return model_of(row);
}

Model make_channel(int n) {
  BRepBuilderAPI_Sewing sewing(1e-6);
  const auto add = [&](const gp_Pnt& a, const gp_Pnt& b) {
    const auto at_end = [](const gp_Pnt& p) { return gp_Pnt(30, p.Y(), p.Z()); };
    sewing.Add(BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakePolygon(a, b, at_end(b), at_end(a), true).Wire()).Face());
  };
  for (int i = 0; i < n; ++i) add(gp_Pnt(0, 0.01 * i, 0), gp_Pnt(0, 0.01 * (i + 1), 0));
  for (const double y : {0.0, 0.01 * n}) add(gp_Pnt(0, y, 0), gp_Pnt(0, y, 1));
  sewing.Perform();
  return model_of(sewing.SewedShape());
}

struct Oracle::Impl {
  TopTools_IndexedMapOfShape faces, edges;
};

Oracle::Oracle(const std::vector<std::byte>& brep) : impl_(std::make_unique<Impl>()) {
  std::istringstream stream(std::string(reinterpret_cast<const char*>(brep.data()), brep.size()), std::ios::binary);
  TopoDS_Shape shape;
  BinTools::Read(shape, stream);
  TopExp::MapShapes(shape, TopAbs_FACE, impl_->faces);
  TopExp::MapShapes(shape, TopAbs_EDGE, impl_->edges);
}

Oracle::~Oracle() = default;

CurvePoint Oracle::curve(EdgeId e, double t) const {
  double t0, t1;
  gp_Pnt p;
  gp_Vec d1, d2;
  BRep_Tool::Curve(TopoDS::Edge(impl_->edges(e + 1)), t0, t1)->D2(t, p, d1, d2);
  return {vec(p), vec(d1), vec(d2)};
}

SurfacePoint2 Oracle::surface(FaceId f, Vec2 uv) const {
  gp_Pnt p;
  gp_Vec u, v, uu, vv, mixed;
  BRep_Tool::Surface(TopoDS::Face(impl_->faces(f + 1)))->D2(uv.x, uv.y, p, u, v, uu, vv, mixed);
  return {vec(p), vec(u), vec(v), vec(uu), vec(mixed), vec(vv)};
}

double Oracle::edge_length(EdgeId e) const {
  return GCPnts_AbscissaPoint::Length(BRepAdaptor_Curve(TopoDS::Edge(impl_->edges(e + 1))), 1e-10);
}

}  // namespace st::test
