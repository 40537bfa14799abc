#include "geometry/import/vertex_loops.h"

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Curve.hxx>
#include <Geom_ElementarySurface.hxx>
#include <Geom_Surface.hxx>
#include <Precision.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "geometry/brep/replace_children.h"

namespace st::occt {
namespace {

struct Bounds {
  double u_min = 0, u_max = 0, v_min = 0, v_max = 0;

  explicit Bounds(const Geom_Surface& surface) { surface.Bounds(u_min, u_max, v_min, v_max); }
};

bool is_same_point(const gp_Pnt& a, const gp_Pnt& b) { return a.Distance(b) < Precision::Confusion(); }

/// Whether the line of constant v is a point.
bool is_pole(const Geom_Surface& surface, const Bounds& b, double v) {
  constexpr int kStations = 4;
  for (int k = 1; k < kStations; ++k)
    if (!is_same_point(surface.Value(b.u_min, v), surface.Value(b.u_min + k * (b.u_max - b.u_min) / kStations, v)))
      return false;
  return true;
}

/// Closed in u, and from pole to pole or closed in v.
bool has_no_border(const Geom_Surface& surface) {
  const Bounds b(surface);
  for (double x : {b.u_min, b.u_max, b.v_min, b.v_max})
    if (Precision::IsInfinite(x)) return false;
  if (!surface.IsUClosed()) return false;
  return surface.IsVClosed() || (is_pole(surface, b, b.v_min) && is_pole(surface, b, b.v_max));
}

/// Whether all edges are points.
bool is_point(const TopoDS_Shape& wire) {
  for (TopoDS_Iterator e(wire); e.More(); e.Next())
    if (e.Value().ShapeType() == TopAbs_EDGE && !BRep_Tool::Degenerated(TopoDS::Edge(e.Value()))) return false;
  return true;
}

/// The loops of a face by what they are; none where one of them passes a seam.
struct Loops {
  std::vector<TopoDS_Shape> points, holes;
};

std::optional<Loops> loops_of(const TopoDS_Face& face) {
  Loops loops;
  for (TopoDS_Iterator w(face); w.More(); w.Next()) {
    if (w.Value().ShapeType() != TopAbs_WIRE) return std::nullopt;
    (is_point(w.Value()) ? loops.points : loops.holes).push_back(w.Value());
    for (TopoDS_Iterator e(w.Value()); e.More(); e.Next())
      if (BRep_Tool::IsClosed(TopoDS::Edge(e.Value()), face)) return std::nullopt;
  }
  return loops;
}

/// The u of places on an edge, by its curve on the face, or by those in space nearest to which the surface is.
std::vector<double> places_of(const TopoDS_Edge& edge, const TopoDS_Face& face, ShapeAnalysis_Surface& surface) {
  constexpr int kPlaces = 32;
  double t0, t1;
  const Handle(Geom2d_Curve) flat = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
  Handle(Geom_Curve) curve;
  if (flat.IsNull()) curve = BRep_Tool::Curve(edge, t0, t1);
  std::vector<double> places;
  for (int k = 0; k <= kPlaces && !(flat.IsNull() && curve.IsNull()); ++k) {
    const double t = t0 + k * (t1 - t0) / kPlaces;
    places.push_back((flat.IsNull() ? surface.ValueOfUV(curve->Value(t), Precision::Confusion()) : flat->Value(t)).X());
  }
  return places;
}

/// The u of places on the holes, from 0 to the width of the bounds, ascending; empty where an edge has no curve.
std::vector<double> places_of(const std::vector<TopoDS_Shape>& holes, const TopoDS_Face& face, const Bounds& bounds) {
  const double width = bounds.u_max - bounds.u_min;
  ShapeAnalysis_Surface surface(BRep_Tool::Surface(face));
  std::vector<double> places;
  for (const TopoDS_Shape& hole : holes)
    for (TopoDS_Iterator e(hole); e.More(); e.Next()) {
      const std::vector<double> of_edge = places_of(TopoDS::Edge(e.Value()), face, surface);
      if (of_edge.empty()) return {};
      for (const double u : of_edge)
        places.push_back(u - bounds.u_min - width * std::floor((u - bounds.u_min) / width));
    }
  std::ranges::sort(places);
  return places;
}

/// Where the seam meets no hole, as u: at the bounds if it can be there; nullopt: nowhere.
std::optional<double> seam_beside(const std::vector<double>& places, const Bounds& bounds, bool is_periodic) {
  constexpr double kMargin = 0.01;  // of the width of the bounds
  const double width = bounds.u_max - bounds.u_min;
  if (places.empty()) return std::nullopt;
  const bool is_inside = places.front() > 1e-6 * width && places.back() < (1 - 1e-6) * width;
  if (is_inside && places.front() + width - places.back() > kMargin * width) return bounds.u_min;
  if (!is_periodic) return is_inside ? std::optional(bounds.u_min) : std::nullopt;
  double best = 0, at = 0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const double next = k + 1 < places.size() ? places[k + 1] : places.front() + width;
    if (next - places[k] > best) best = next - places[k], at = 0.5 * (next + places[k]);
  }
  return best > kMargin * width ? std::optional(bounds.u_min + at) : std::nullopt;
}

/// The loop around the whole surface, with its curves on that; null where none can be made.
TopoDS_Shape natural_loop(const Handle(Geom_Surface) & surface, double seam, double tolerance) {
  const Bounds b(*surface);
  BRepBuilderAPI_MakeFace face(surface, seam, seam + b.u_max - b.u_min, b.v_min, b.v_max, tolerance);
  if (!face.IsDone()) return {};
  const TopoDS_Iterator wire(face.Face().Oriented(TopAbs_FORWARD));
  return wire.More() ? wire.Value() : TopoDS_Shape();
}

/// The loop around the surface of a face, beside holes in it; null where none can be made.
TopoDS_Shape loop_beside(const std::vector<TopoDS_Shape>& holes, const TopoDS_Face& face,
                         const Handle(Geom_Surface) & surface) {
  if (!has_no_border(*surface)) return {};
  const Bounds bounds(*surface);
  const auto seam = seam_beside(places_of(holes, face, bounds), bounds, surface->IsUPeriodic());
  return seam ? natural_loop(surface, *seam, BRep_Tool::Tolerance(face)) : TopoDS_Shape();
}

bool bound(const TopoDS_Face& face) {
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  if (surface.IsNull() || surface->IsKind(STANDARD_TYPE(Geom_ElementarySurface))) return false;
  const std::optional<Loops> loops = loops_of(face);
  return loops && !loops->points.empty() && bound_around_holes(face);
}

}  // namespace

int bound_whole_surfaces(std::span<const TopoDS_Face> faces) {
  return static_cast<int>(std::ranges::count_if(faces, bound));
}

bool bound_around_holes(const TopoDS_Face& face) {
  TopLoc_Location location;
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face, location);
  const std::optional<Loops> loops = loops_of(face);
  if (surface.IsNull() || !location.IsIdentity() || !loops || loops->holes.empty()) return false;
  const TopoDS_Shape loop = loop_beside(loops->holes, face, surface);
  if (!loop.IsNull()) replace_children(face, loops->points, {loop});
  return !loop.IsNull();
}

}  // namespace st::occt
