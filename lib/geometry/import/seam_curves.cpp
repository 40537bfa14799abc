#include "geometry/import/seam_curves.h"

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Curve.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_Surface.hxx>
#include <Precision.hxx>
#include <ShapeAnalysis_Curve.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>
#include <vector>

namespace st::occt {
namespace {

/// The poles of a surface at the bounds of v.
std::vector<gp_Pnt> poles_of(const Geom_Surface& surface) {
  constexpr int kStations = 4;
  double u0, u1, v0, v1;
  surface.Bounds(u0, u1, v0, v1);
  std::vector<gp_Pnt> poles;
  for (const double v : {v0, v1}) {
    if (Precision::IsInfinite(v)) continue;
    bool is_pole = true;
    const gp_Pnt p = surface.Value(u0, v);
    for (int k = 1; k < kStations; ++k)
      is_pole = is_pole && surface.Value(u0 + k * (u1 - u0) / kStations, v).Distance(p) < Precision::Confusion();
    if (is_pole) poles.push_back(p);
  }
  return poles;
}

bool ends_at(const TopoDS_Edge& edge, const std::vector<gp_Pnt>& poles) {
  return std::ranges::any_of(poles, [&](const gp_Pnt& pole) {
    for (TopoDS_Iterator v(edge); v.More(); v.Next()) {
      const TopoDS_Vertex vertex = TopoDS::Vertex(v.Value());
      if (BRep_Tool::Pnt(vertex).Distance(pole) < BRep_Tool::Tolerance(vertex)) return true;
    }
    return false;
  });
}

/// The edges that a loop passes twice and that have no curves on the face, if these are several, or another edge of the
/// loop ends at a pole.
std::vector<TopoDS_Edge> bare_seams_of(const TopoDS_Shape& wire, const TopoDS_Face& face,
                                       const std::vector<gp_Pnt>& poles) {
  TopTools_IndexedMapOfShape edges;
  std::vector<int> n_uses;
  for (TopoDS_Iterator e(wire); e.More(); e.Next()) {
    const std::size_t k = edges.Add(e.Value().Oriented(TopAbs_FORWARD));
    if (k > n_uses.size()) n_uses.push_back(0);
    ++n_uses[k - 1];
  }
  std::vector<TopoDS_Edge> seams;
  bool is_at_pole = false;
  for (int k = 1; k <= edges.Extent(); ++k) {
    const TopoDS_Edge edge = TopoDS::Edge(edges(k));
    double t0, t1;
    if (BRep_Tool::Degenerated(edge)) continue;
    if (n_uses[k - 1] != 2)
      is_at_pole = is_at_pole || ends_at(edge, poles);
    else if (BRep_Tool::CurveOnSurface(edge, face, t0, t1).IsNull())
      seams.push_back(edge);
  }
  return is_at_pole || seams.size() > 1 ? seams : std::vector<TopoDS_Edge>();
}

/// A straight curve from `a` at the parameter `t0` to `b` at `t1`.
Handle(Geom2d_Curve) line(const gp_Pnt2d& a, const gp_Pnt2d& b, double t0, double t1) {
  TColgp_Array1OfPnt2d poles(1, 2);
  TColStd_Array1OfReal knots(1, 2);
  TColStd_Array1OfInteger multiplicities(1, 2);
  poles(1) = a, poles(2) = b;
  knots(1) = t0, knots(2) = t1;
  multiplicities.Init(2);
  return new Geom2d_BSplineCurve(poles, knots, multiplicities, 1);
}

/// The meridian of a seam at the lower bound of u, its parameter going with that of the edge; false where it is none.
bool ends_at_bound(const TopoDS_Edge& seam, ShapeAnalysis_Surface& surface, gp_Pnt2d& first, gp_Pnt2d& last) {
  constexpr double kOnBound = 1e-6;  // of the period
  constexpr int kPlaces = 6;         // inside the edge: its ends may be poles
  double u0, u1, v0, v1, t0, t1;
  surface.Surface()->Bounds(u0, u1, v0, v1);
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(seam, t0, t1);
  if (curve.IsNull()) return false;
  std::vector<double> v;
  for (int k = 1; k <= kPlaces; ++k) {
    const gp_Pnt2d uv = surface.ValueOfUV(curve->Value(t0 + k * (t1 - t0) / (kPlaces + 1)), BRep_Tool::Tolerance(seam));
    const double periods = (uv.X() - u0) / (u1 - u0);
    if (std::abs(periods - std::round(periods)) > kOnBound) return false;
    v.push_back(uv.Y());
  }
  const double step = (v.back() - v.front()) / (kPlaces - 1);
  for (int k = 0; k < kPlaces; ++k)
    if (std::abs(v[k] - v[0] - k * step) > kOnBound * (u1 - u0)) return false;
  first = {u0, v.front() - step};
  last = {u0, v.back() + step};
  return true;
}

bool give_curves(const TopoDS_Edge& seam, const TopoDS_Face& face, ShapeAnalysis_Surface& surface) {
  gp_Pnt2d a, b;
  if (!ends_at_bound(seam, surface, a, b)) return false;
  double t0, t1;
  BRep_Tool::Range(seam, t0, t1);
  double u0, u1, v0, v1;
  surface.Surface()->Bounds(u0, u1, v0, v1);
  const gp_Vec2d period(u1 - u0, 0);
  const Handle(Geom2d_Curve) low = line(a, b, t0, t1);
  const Handle(Geom2d_Curve) high = line(a.Translated(period), b.Translated(period), t0, t1);
  const bool is_up = b.Y() > a.Y();  // the face is on the left: upwards along the upper bound
  BRep_Builder().UpdateEdge(seam, is_up ? high : low, is_up ? low : high, face, BRep_Tool::Tolerance(seam));
  BRep_Builder().Range(seam, face, t0, t1);
  return true;
}

/// Gives curves to the seams that `seams_of` finds in the loops of faces that are closed in u and have poles.
template <class SeamsOf>
int give_curves_in_loops(const TopoDS_Shape& shape, SeamsOf seams_of) {
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  int n = 0;
  for (int f = 1; f <= faces.Extent(); ++f) {
    const TopoDS_Face face = TopoDS::Face(faces(f).Oriented(TopAbs_FORWARD));
    TopLoc_Location location;
    const Handle(Geom_Surface) geometry = BRep_Tool::Surface(face, location);
    if (geometry.IsNull() || !location.IsIdentity() || !geometry->IsUClosed()) continue;
    const std::vector<gp_Pnt> poles = poles_of(*geometry);
    if (poles.empty()) continue;
    ShapeAnalysis_Surface surface(geometry);
    for (TopoDS_Iterator w(face); w.More(); w.Next())
      if (w.Value().ShapeType() == TopAbs_WIRE)
        for (const TopoDS_Edge& seam : seams_of(w.Value(), face, poles)) n += give_curves(seam, face, surface);
  }
  return n;
}

/// Whole turns that bring the middle of a curve between the poles of a sphere; 0 where it is there.
double turns_inside(const Geom2d_Curve& curve, double t0, double t1) {
  return -2 * M_PI * std::round(curve.Value(0.5 * (t0 + t1)).Y() / (2 * M_PI));
}

/// Moves the curves of an edge on a sphere by whole turns in v; whether any was moved.
bool move_inside(const TopoDS_Edge& edge, const TopoDS_Face& face) {
  double t0, t1;
  const Handle(Geom2d_Curve) there = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
  if (there.IsNull() || turns_inside(*there, t0, t1) == 0) return false;
  const auto moved = [&](const Handle(Geom2d_Curve) & curve) {
    const auto copy = Handle(Geom2d_Curve)::DownCast(curve->Copy());
    copy->Translate(gp_Vec2d(0, turns_inside(*curve, t0, t1)));
    return copy;
  };
  if (BRep_Tool::IsClosed(edge, face)) {
    const Handle(Geom2d_Curve) back = BRep_Tool::CurveOnSurface(TopoDS::Edge(edge.Reversed()), face, t0, t1);
    BRep_Builder().UpdateEdge(edge, moved(there), moved(back), face, BRep_Tool::Tolerance(edge));
  } else {
    BRep_Builder().UpdateEdge(edge, moved(there), face, BRep_Tool::Tolerance(edge));
  }
  BRep_Builder().Range(edge, face, t0, t1);
  return true;
}

/// Whether one edge of a loop is the other, passed in the other direction.
bool is_way_back(const TopoDS_Edge& edge, const TopoDS_Edge& other) {
  constexpr int kPlaces = 4;
  constexpr double kSame = 1e-5;  // of its length: files hold few digits
  double t0, t1, s0, s1;
  const Handle(Geom_Curve) there = BRep_Tool::Curve(edge, t0, t1), back = BRep_Tool::Curve(other, s0, s1);
  if (there.IsNull() || back.IsNull()) return false;
  const gp_Pnt middle = there->Value(0.5 * (t0 + t1));
  const double length = there->Value(t0).Distance(middle) + middle.Distance(there->Value(t1));
  const double tolerance =
      std::max(kSame * length, 2 * std::max(BRep_Tool::Tolerance(edge), BRep_Tool::Tolerance(other)));
  const bool is_turned = edge.Orientation() != other.Orientation();
  const gp_Pnt begin = back->Value(is_turned ? s0 : s1), end = back->Value(is_turned ? s1 : s0);
  if (there->Value(t0).Distance(begin) > tolerance || there->Value(t1).Distance(end) > tolerance) return false;
  for (int k = 1; k < kPlaces; ++k) {
    gp_Pnt at;
    double t;
    const gp_Pnt p = there->Value(t0 + k * (t1 - t0) / kPlaces);
    if (ShapeAnalysis_Curve().Project(back, p, tolerance, at, t, s0, s1, false) > tolerance) return false;
  }
  return true;
}

/// Puts the first edge in the place of another that is its way back; the edges that became seams.
std::vector<TopoDS_Edge> join_ways_back(TopoDS_Shape& wire, const TopoDS_Face& face) {
  std::vector<TopoDS_Edge> edges, seams;
  double t0, t1;
  for (TopoDS_Iterator e(wire, false); e.More(); e.Next()) edges.push_back(TopoDS::Edge(e.Value()));
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t k = i + 1; k < edges.size(); ++k) {
      if (edges[i].IsSame(edges[k]) || !BRep_Tool::CurveOnSurface(edges[i], face, t0, t1).IsNull()) continue;
      if (!is_way_back(edges[i], edges[k])) continue;
      edges[k] = TopoDS::Edge(edges[i].Reversed());
      seams.push_back(TopoDS::Edge(edges[i].Oriented(TopAbs_FORWARD)));
    }
  if (seams.empty()) return seams;
  BRep_Builder builder;
  const bool was_free = wire.Free();
  wire.Free(true);
  std::vector<TopoDS_Shape> all;
  for (TopoDS_Iterator e(wire, false); e.More(); e.Next()) all.push_back(e.Value());
  for (const TopoDS_Shape& e : all) builder.Remove(wire, e);
  for (const TopoDS_Edge& e : edges) builder.Add(wire, e);
  wire.Free(was_free);
  return seams;
}

}  // namespace

int give_seams_curves(const TopoDS_Shape& shape) {
  return give_curves_in_loops(shape, [](TopoDS_Shape wire, const TopoDS_Face& face, const std::vector<gp_Pnt>& poles) {
    return bare_seams_of(wire, face, poles);
  });
}

int make_seams(const TopoDS_Shape& shape) {
  return give_curves_in_loops(shape, [](TopoDS_Shape wire, const TopoDS_Face& face, const std::vector<gp_Pnt>&) {
    return join_ways_back(wire, face);
  });
}

int move_curves_between_poles(const TopoDS_Shape& shape) {
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  int n = 0;
  for (int f = 1; f <= faces.Extent(); ++f) {
    const TopoDS_Face face = TopoDS::Face(faces(f).Oriented(TopAbs_FORWARD));
    TopLoc_Location location;
    const Handle(Geom_Surface) surface = BRep_Tool::Surface(face, location);
    if (surface.IsNull() || !surface->IsKind(STANDARD_TYPE(Geom_SphericalSurface))) continue;
    TopTools_IndexedMapOfShape edges;
    TopExp::MapShapes(face, TopAbs_EDGE, edges);
    for (int e = 1; e <= edges.Extent(); ++e) n += move_inside(TopoDS::Edge(edges(e).Oriented(TopAbs_FORWARD)), face);
  }
  return n;
}

}  // namespace st::occt
