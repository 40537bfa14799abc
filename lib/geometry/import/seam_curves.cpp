#include "geometry/import/seam_curves.h"

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2dAPI_Interpolate.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Curve.hxx>
#include <GeomAPI_ProjectPointOnCurve.hxx>
#include <Geom_Curve.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_Surface.hxx>
#include <Precision.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TColgp_HArray1OfPnt2d.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "geometry/brep/replace_children.h"

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

/// Whether a seam's curves are each on the side of the other: the face is on the left, so upwards is along the upper u.
bool is_on_wrong_side(const Geom2d_Curve& forward, double t0, double t1, const Geom_Surface& surface) {
  double u0, u1, v0, v1;
  surface.Bounds(u0, u1, v0, v1);
  const bool is_up = forward.Value(t1).Y() > forward.Value(t0).Y();
  return is_up != (forward.Value(0.5 * (t0 + t1)).X() > 0.5 * (u0 + u1));
}

/// The edges that a loop passes twice and that have no curves on the face, if there is another such edge or one of the
/// loop ends at a pole; then also those that have their curves on the wrong sides.
std::vector<TopoDS_Edge> bare_seams_of(const TopoDS_Shape& wire, const TopoDS_Face& face,
                                       const std::vector<gp_Pnt>& poles) {
  TopTools_IndexedMapOfShape edges;
  std::vector<int> n_uses;
  for (TopoDS_Iterator e(wire); e.More(); e.Next()) {
    const std::size_t k = edges.Add(e.Value().Oriented(TopAbs_FORWARD));
    if (k > n_uses.size()) n_uses.push_back(0);
    ++n_uses[k - 1];
  }
  std::vector<TopoDS_Edge> bare, wrong;
  bool is_at_pole = false;
  for (int k = 1; k <= edges.Extent(); ++k) {
    const TopoDS_Edge edge = TopoDS::Edge(edges(k));
    double t0, t1;
    if (BRep_Tool::Degenerated(edge)) continue;
    const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
    if (n_uses[k - 1] != 2)
      is_at_pole = is_at_pole || ends_at(edge, poles);
    else if (curve.IsNull())
      bare.push_back(edge);
    else if (is_on_wrong_side(*curve, t0, t1, *BRep_Tool::Surface(face)))
      wrong.push_back(edge);
  }
  const bool is_in_pieces = !bare.empty() && std::ranges::count(n_uses, 2) > 1;
  if (!is_at_pole && !is_in_pieces) return {};
  bare.insert(bare.end(), wrong.begin(), wrong.end());
  return bare;
}

/// The lower bound of u, with the parameter of a seam that runs along it; null where the seam is elsewhere.
Handle(Geom2d_Curve) along_bound(const TopoDS_Edge& seam, ShapeAnalysis_Surface& surface) {
  constexpr double kOnBound = 1e-5;  // of the period
  constexpr int kPlaces = 16;
  double u0, u1, v0, v1, t0, t1;
  surface.Surface()->Bounds(u0, u1, v0, v1);
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(seam, t0, t1);
  if (curve.IsNull()) return {};
  const Handle(TColgp_HArray1OfPnt2d) places = new TColgp_HArray1OfPnt2d(1, kPlaces + 1);
  const Handle(TColStd_HArray1OfReal) parameters = new TColStd_HArray1OfReal(1, kPlaces + 1);
  for (int k = 0; k <= kPlaces; ++k) {
    const double t = t0 + k * (t1 - t0) / kPlaces;
    const gp_Pnt2d uv = surface.ValueOfUV(curve->Value(t), BRep_Tool::Tolerance(seam));
    const double periods = (uv.X() - u0) / (u1 - u0);
    const bool is_end = k == 0 || k == kPlaces;  // which may be a pole, where u is any
    if (!is_end && std::abs(periods - std::round(periods)) > kOnBound) return {};
    places->SetValue(k + 1, {u0, uv.Y()});
    parameters->SetValue(k + 1, t);
  }
  Geom2dAPI_Interpolate spline(places, parameters, false, Precision::PConfusion());
  spline.Perform();
  if (!spline.IsDone()) return {};
  return Handle(Geom2d_Curve)(spline.Curve());
}

bool give_curves(const TopoDS_Edge& seam, const TopoDS_Face& face, ShapeAnalysis_Surface& surface) {
  const Handle(Geom2d_Curve) low = along_bound(seam, surface);
  if (low.IsNull()) return false;
  double u0, u1, v0, v1, t0, t1;
  surface.Surface()->Bounds(u0, u1, v0, v1);
  BRep_Tool::Range(seam, t0, t1);
  const auto high = Handle(Geom2d_Curve)::DownCast(low->Translated(gp_Vec2d(u1 - u0, 0)));
  const bool is_up = low->Value(t1).Y() > low->Value(t0).Y();  // the face is on the left: upwards along the upper bound
  BRep_Builder().UpdateEdge(seam, is_up ? high : low, is_up ? low : high, face, BRep_Tool::Tolerance(seam));
  BRep_Builder().Range(seam, face, t0, t1);
  return true;
}

/// Gives curves to the seams that `seams_of` finds in the loops of faces that are closed in u and have poles.
template <class SeamsOf>
int give_curves_in_loops(std::span<const TopoDS_Face> faces, SeamsOf seams_of) {
  int n = 0;
  for (const TopoDS_Face& face : faces) {
    const Handle(Geom_Surface) geometry = BRep_Tool::Surface(face);
    if (geometry.IsNull() || !geometry->IsUClosed()) continue;
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
    const GeomAPI_ProjectPointOnCurve foot(there->Value(t0 + k * (t1 - t0) / kPlaces), back, s0, s1);
    if (foot.NbPoints() == 0 || foot.LowerDistance() > tolerance) return false;
  }
  return true;
}

std::vector<TopoDS_Edge> edges_of(const TopoDS_Shape& wire) {
  std::vector<TopoDS_Edge> edges;
  for (TopoDS_Iterator e(wire, false); e.More(); e.Next()) edges.push_back(TopoDS::Edge(e.Value()));
  return edges;
}

/// Puts the first edge in the place of another where `join(edge, other)` says so; the edges that became seams.
template <class Join>
std::vector<TopoDS_Edge> join_edges(TopoDS_Shape& wire, Join join) {
  std::vector<TopoDS_Edge> edges = edges_of(wire), seams;
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t k = i + 1; k < edges.size(); ++k) {
      if (edges[i].IsSame(edges[k]) || !join(edges[i], edges[k])) continue;
      edges[k] = TopoDS::Edge(edges[i].Reversed());
      seams.push_back(TopoDS::Edge(edges[i].Oriented(TopAbs_FORWARD)));
    }
  if (!seams.empty()) replace_children(wire, edges_of(wire), edges);
  return seams;
}

/// The vector from the way there to the way back where two edges of a loop lie a period of the face's surface apart.
std::optional<gp_Vec2d> across_period(const TopoDS_Edge& edge, const TopoDS_Edge& other, const TopoDS_Face& face) {
  constexpr double kSame = 1e-4;  // of the widths: files hold few digits
  double u0, u1, v0, v1, t0, t1, s0, s1;
  BRep_Tool::Surface(face)->Bounds(u0, u1, v0, v1);
  const Handle(Geom2d_Curve) there = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
  const Handle(Geom2d_Curve) back = BRep_Tool::CurveOnSurface(other, face, s0, s1);
  if (there.IsNull() || back.IsNull()) return std::nullopt;
  if (edge.Orientation() == TopAbs_REVERSED) std::swap(t0, t1);
  if (other.Orientation() == TopAbs_REVERSED) std::swap(s0, s1);
  const auto is_same = [&](gp_Vec2d a) {
    return std::abs(a.X()) < kSame * (u1 - u0) && std::abs(a.Y()) < kSame * (v1 - v0);
  };
  for (const gp_Vec2d shift : {gp_Vec2d(u1 - u0, 0), gp_Vec2d(u0 - u1, 0), gp_Vec2d(0, v1 - v0), gp_Vec2d(0, v0 - v1)})
    if (is_same(gp_Vec2d(there->Value(t0), back->Value(s1)) - shift) &&
        is_same(gp_Vec2d(there->Value(t1), back->Value(s0)) - shift))
      return shift;
  return std::nullopt;
}

/// Whether an edge runs along the bounds of the face's surface.
bool is_along_bounds(const TopoDS_Edge& edge, const TopoDS_Face& face) {
  constexpr double kOnBound = 1e-4;  // of the width
  double u0, u1, v0, v1, t0, t1;
  BRep_Tool::Surface(face)->Bounds(u0, u1, v0, v1);
  const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
  if (curve.IsNull()) return false;
  const gp_Pnt2d p[] = {curve->Value(t0), curve->Value(0.5 * (t0 + t1)), curve->Value(t1)};
  const auto all_near = [&](auto coordinate, double bound, double width) {
    return std::ranges::all_of(p, [&](gp_Pnt2d q) { return std::abs(coordinate(q) - bound) < kOnBound * width; });
  };
  const auto u_of = [](gp_Pnt2d q) { return q.X(); };
  const auto v_of = [](gp_Pnt2d q) { return q.Y(); };
  return all_near(u_of, u0, u1 - u0) || all_near(u_of, u1, u1 - u0) || all_near(v_of, v0, v1 - v0) ||
         all_near(v_of, v1, v1 - v0);
}

/// Whether each edge of a loop along the bounds has a way back a period apart: another one is a side of a notch.
bool has_whole_seams(const TopoDS_Shape& wire, const TopoDS_Face& face) {
  const std::vector<TopoDS_Edge> edges = edges_of(wire);
  return std::ranges::all_of(edges, [&](const TopoDS_Edge& edge) {
    return !is_along_bounds(edge, face) || std::ranges::any_of(edges, [&](const TopoDS_Edge& other) {
      return !other.IsSame(edge) && across_period(edge, other, face);
    });
  });
}

/// Makes one seam of two edges of a loop that lie a period apart, with the curve of the first on either side.
int join_across_periods(TopoDS_Shape wire, const TopoDS_Face& face) {
  const auto join = [&](const TopoDS_Edge& edge, const TopoDS_Edge& other) {
    const std::optional<gp_Vec2d> shift = across_period(edge, other, face);
    if (!shift || !is_way_back(edge, other)) return false;
    double t0, t1;
    const Handle(Geom2d_Curve) there = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
    const auto back = Handle(Geom2d_Curve)::DownCast(there->Translated(*shift));
    const bool is_forward = edge.Orientation() == TopAbs_FORWARD;
    const TopoDS_Edge seam = TopoDS::Edge(edge.Oriented(TopAbs_FORWARD));
    BRep_Builder().UpdateEdge(seam, is_forward ? there : back, is_forward ? back : there, face,
                              BRep_Tool::Tolerance(edge));
    BRep_Builder().Range(seam, face, t0, t1);
    return true;
  };
  return static_cast<int>(join_edges(wire, join).size());
}

}  // namespace

int give_seams_curves(std::span<const TopoDS_Face> faces) { return give_curves_in_loops(faces, bare_seams_of); }

int make_seams(std::span<const TopoDS_Face> faces) {
  int n = give_curves_in_loops(faces, [](TopoDS_Shape wire, const TopoDS_Face& face, const std::vector<gp_Pnt>&) {
    return join_edges(wire, [&](const TopoDS_Edge& edge, const TopoDS_Edge& other) {
      double t0, t1;
      return BRep_Tool::CurveOnSurface(edge, face, t0, t1).IsNull() && is_way_back(edge, other);
    });
  });
  for (const TopoDS_Face& face : faces) {
    const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
    if (surface.IsNull() || !surface->IsUClosed() || !surface->IsVClosed()) continue;
    for (TopoDS_Iterator w(face); w.More(); w.Next())
      if (w.Value().ShapeType() == TopAbs_WIRE)
        n += has_whole_seams(w.Value(), face) ? join_across_periods(w.Value(), face) : 0;
  }
  return n;
}

int move_curves_between_poles(std::span<const TopoDS_Face> faces) {
  int n = 0;
  for (const TopoDS_Face& face : faces) {
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
