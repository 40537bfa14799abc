#include "geometry/import/pcurve_repair.h"

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <ShapeConstruct_ProjectCurveOnSurface.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/threads.h"
#include "geometry/brep/face_domain.h"
#include "geometry/brep/face_integral.h"
#include "geometry/brep/loop_crossing.h"
#include "geometry/brep/occt_evaluators.h"
#include "geometry/brep/pcurve_fit.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/brep/uv_box.h"
#include "geometry/import/import.h"
#include "geometry/model/sameness.h"

namespace st::occt {
namespace {

constexpr int kFewSamples = 17, kManySamples = 1025;  // to look, to judge
constexpr double kExcess = 2.0;                       // of the tolerance: readers leave distances just above it
constexpr double kWide = 1e-3;  // of the diagonal: what st-check accepts of nodes at most; more is no tolerance
constexpr double kFar = 0.01;   // of the edge: a curve that moves by less leaves its face in shape

constexpr double kRoom = 3;         // times the length of the edge times its gap: what moving a curve changes at most
constexpr double kMeasured = 1e-3;  // of the area: ways of measuring differ
constexpr double kFit = 0.1;        // of what is harmless: how exactly curves of loops that cross are projected
constexpr double kMuchLess = 0.1;   // of the part that a crossing of loops cuts off: what may be left of it

/// A use of an edge by a face, with what is needed to compare its curves.
struct Use {
  TopoDS_Edge edge;
  TopoDS_Face face;
  Handle(Geom_Curve) curve;
  Handle(Geom_Surface) surface;
  double t0 = 0, t1 = 0;
};

struct Gap {
  double distance = 0;
  Vec3 xyz;  ///< on the space curve
};

/// `point`: of the surface at a place in (u,v).
template <class Point>
Gap largest_gap(const Use& use, const Handle(Geom2d_Curve) & pcurve, int n_samples, const Point& point) {
  Gap gap;
  for (int k = 0; k < n_samples; ++k) {
    const double s = 0.5 - 0.5 * std::cos(kPi * k / (n_samples - 1));  // closer at the ends: there curves part
    const double t = use.t0 + (use.t1 - use.t0) * s;
    const Vec3 p = vec(use.curve->Value(t));
    const double d = distance(p, point(pcurve->Value(t)));
    if (d > gap.distance) gap = {d, p};
  }
  return gap;
}
Gap largest_gap(const Use& use, const Handle(Geom2d_Curve) & pcurve, int n_samples) {
  return largest_gap(use, pcurve, n_samples,
                     [&](const gp_Pnt2d& uv) { return vec(use.surface->Value(uv.X(), uv.Y())); });
}

/// The multiple of `period` that brings `from` nearest to `to`.
double periods_between(double from, double to, bool is_periodic, double period) {
  return is_periodic ? period * std::round((to - from) / period) : 0.0;
}

/// The candidate in the period of the old curve; null when one of its ends is elsewhere in (u,v) than the old one: at a
/// pole any u lies on the edge, but only one closes the loop.
Handle(Geom2d_Curve)
    in_place(const Use& use, const Handle(Geom2d_Curve) & old, const Handle(Geom2d_Curve) & candidate) {
  constexpr double kMaxShift = 0.01;  // of the face's range
  if (candidate.IsNull()) return {};
  const Box2 b = uv_box(use.face);
  const GeomAdaptor_Surface s(use.surface);
  const double middle = 0.5 * (use.t0 + use.t1);
  const gp_Pnt2d from = candidate->Value(middle), to = old->Value(middle);
  const double u = periods_between(from.X(), to.X(), s.IsUPeriodic(), s.IsUPeriodic() ? s.UPeriod() : 0);
  const double v = periods_between(from.Y(), to.Y(), s.IsVPeriodic(), s.IsVPeriodic() ? s.VPeriod() : 0);
  const Handle(Geom2d_Curve) moved = Handle(Geom2d_Curve)::DownCast(candidate->Translated(gp_Vec2d(u, v)));
  for (const double t : {use.t0, use.t1}) {
    const gp_Pnt2d p = moved->Value(t), q = old->Value(t);
    if (std::abs(p.X() - q.X()) > kMaxShift * (b.hi.x - b.lo.x) ||
        std::abs(p.Y() - q.Y()) > kMaxShift * (b.hi.y - b.lo.y))
      return {};
  }
  return moved;
}

/// Trimming curve by projection; null when that fails.
Handle(Geom2d_Curve) projected(const Use& use) {
  try {
    ShapeConstruct_ProjectCurveOnSurface projector;
    projector.Init(use.surface, 1e-7);
    Handle(Geom_Curve) curve = use.curve;
    Handle(Geom2d_Curve) result;
    if (!projector.Perform(curve, use.t0, use.t1, result)) return {};
    return result;
  } catch (const Standard_Failure&) {
    return {};
  }
}

/// Projected point by point from the old curve, which is near; null when a point has no projection there.
Handle(Geom2d_Curve) resampled(const Use& use, const Handle(Geom2d_Curve) & old, double target) {
  const auto guess = [&](double t) {
    const gp_Pnt2d uv = old->Value(t);
    return Vec2{uv.X(), uv.Y()};
  };
  return fit_pcurve({use.curve, use.t0, use.t1}, *make_surface(use.surface, uv_box(use.face)), guess, target);
}

std::string entity(int edge, int face) { return "edge " + std::to_string(edge) + " in face " + std::to_string(face); }

/// The edge's tolerance covers `distance`, its vertices' the edge's.
void raise_tolerance(const TopoDS_Edge& edge, double distance) {
  BRep_Builder builder;
  builder.UpdateEdge(edge, distance);
  for (TopExp_Explorer v(edge, TopAbs_VERTEX); v.More(); v.Next())
    builder.UpdateVertex(TopoDS::Vertex(v.Current()), distance);
}

double area_of(const TopoDS_Face& face) { return std::abs(integrate_face(make_domain(face), {}).area); }

void set_pcurve(const Use& use, const Handle(Geom2d_Curve) & pcurve) {
  BRep_Builder().UpdateEdge(use.edge, pcurve, use.face, BRep_Tool::Tolerance(use.edge));
  BRep_Builder().Range(use.edge, use.face, use.t0, use.t1);
}

double chord_length(const Use& use) {
  double length = 0;
  for (int k = 1; k < kFewSamples; ++k)
    length += use.curve->Value(use.t0 + (use.t1 - use.t0) * k / (kFewSamples - 1))
                  .Distance(use.curve->Value(use.t0 + (use.t1 - use.t0) * (k - 1) / (kFewSamples - 1)));
  return length;
}

/// A curve that moves by a distance sweeps this area at most, with room for bends: a face that changes by more has got
/// another shape.
bool keeps_shape(const Use& use, double area_before, double moved) {
  return std::abs(area_of(use.face) - area_before) <= kRoom * moved * chord_length(use) + kMeasured * area_before;
}

void repair(const Use& use, const Handle(Geom2d_Curve) & old, double diagonal, const std::string& name,
            std::vector<ImportFinding>& findings) {
  const Gap before = largest_gap(use, old, kManySamples);
  const bool is_seam = BRep_Tool::IsClosed(use.edge, use.face);
  Handle(Geom2d_Curve) better;
  Gap after = before;
  bool is_undone = false;
  const bool is_far = before.distance > kFar * chord_length(use);
  const double area = is_far && !is_seam ? area_of(use.face) : 0;
  const auto consider = [&](const Handle(Geom2d_Curve) & anywhere) {
    const Handle(Geom2d_Curve) candidate = in_place(use, old, anywhere);
    if (candidate.IsNull()) return;
    const Gap gap = largest_gap(use, candidate, kManySamples);
    if (gap.distance >= 0.5 * after.distance) return;
    set_pcurve(use, candidate);
    if (!is_far || keeps_shape(use, area, before.distance))
      after = gap, better = candidate;
    else
      is_undone = true;
    set_pcurve(use, old);
  };
  if (!is_seam) consider(projected(use));
  if (!is_seam && after.distance > BRep_Tool::Tolerance(use.edge))
    consider(resampled(use, old, 0.5 * BRep_Tool::Tolerance(use.edge)));
  const double left = std::min(before.distance, after.distance);
  const bool is_wide = left > kWide * diagonal && left > kFar * chord_length(use);
  if (!better.IsNull()) {
    set_pcurve(use, better);
    findings.push_back({FindingKind::kProjectedCurve, name, before.xyz, before.distance, true,
                        format_number(after.distance / before.distance)});
  } else {
    const auto kind = is_wide ? FindingKind::kFarCurve : FindingKind::kRaisedTolerance;
    findings.push_back({kind, name, before.xyz, before.distance, !is_wide});
    if (is_undone)
      findings.push_back({FindingKind::kUndoneRepair, name, before.xyz, before.distance, false,
                          "the face would have another area with its trimming curve projected again"});
  }
  if (!is_wide && left > BRep_Tool::Tolerance(use.edge)) raise_tolerance(use.edge, 1.01 * left);
}

/// A trimming curve and the one that may take its place.
struct Change {
  Use use;
  Handle(Geom2d_Curve) old, projected;
  Gap gap;  ///< of the old one
};

/// Curves of the face that leave their edges by more than `exact`, projected again.
std::vector<Change> changes_of(const TopoDS_Face& face, double exact) {
  std::vector<Change> changes;
  for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
    Change c;
    double p0 = 0, p1 = 0;
    c.use.edge = TopoDS::Edge(e.Current()), c.use.face = face, c.use.surface = BRep_Tool::Surface(face);
    if (BRep_Tool::Degenerated(c.use.edge) || BRep_Tool::IsClosed(c.use.edge, face)) continue;
    c.old = BRep_Tool::CurveOnSurface(c.use.edge, face, p0, p1);
    c.use.curve = BRep_Tool::Curve(c.use.edge, c.use.t0, c.use.t1);
    if (c.old.IsNull() || c.use.curve.IsNull()) continue;
    c.gap = largest_gap(c.use, c.old, kManySamples);
    if (c.gap.distance <= exact) continue;
    c.projected = resampled(c.use, c.old, kFit * exact);
    if (!c.projected.IsNull() && largest_gap(c.use, c.projected, kManySamples).distance < 0.5 * c.gap.distance)
      changes.push_back(c);
  }
  return changes;
}

double crossing_of(const TopoDS_Face& face, double exact) {
  const auto crossing = find_loop_crossing(make_domain(face), exact);
  return crossing ? crossing->size : 0;
}

/// Whether the face's loops, changed, cross nearly no more and bound what they did.
bool uncross(const TopoDS_Face& face, const std::vector<Change>& changes, double exact) {
  const double size = crossing_of(face, exact), area = area_of(face);
  double room = kMeasured * area;
  for (const Change& c : changes) {
    set_pcurve(c.use, c.projected);
    room += kRoom * c.gap.distance * chord_length(c.use);
  }
  if (crossing_of(face, exact) < kMuchLess * size && std::abs(area_of(face) - area) <= room) return true;
  for (const Change& c : changes) set_pcurve(c.use, c.old);
  return false;
}

/// visit(use, trimming curve) for the face's edges that their trimming curves leave by more than is harmless, or their
/// tolerance says.
template <class Visit>
void visit_leaving(const TopoDS_Shape& face, double diagonal, const Visit& visit) {
  Use use;
  use.face = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  use.surface = BRep_Tool::Surface(use.face);
  if (GeomAdaptor_Surface(use.surface).GetType() == GeomAbs_Plane) return;
  const std::unique_ptr<Surface> surface = make_surface(use.surface);
  for (TopExp_Explorer e(use.face, TopAbs_EDGE); e.More(); e.Next()) {
    use.edge = TopoDS::Edge(e.Current());
    if (BRep_Tool::Degenerated(use.edge)) continue;
    double p0 = 0, p1 = 0;
    const Handle(Geom2d_Curve) pcurve = BRep_Tool::CurveOnSurface(use.edge, use.face, p0, p1);
    use.curve = BRep_Tool::Curve(use.edge, use.t0, use.t1);
    if (pcurve.IsNull() || use.curve.IsNull()) continue;
    const double allowed = std::min(kExcess * BRep_Tool::Tolerance(use.edge), kWide * diagonal);
    const Gap gap = largest_gap(use, pcurve, kFewSamples, [&](const gp_Pnt2d& uv) {
      return surface->point({uv.X(), uv.Y()});
    });
    if (gap.distance > std::max(kHarmless * diagonal, allowed)) visit(use, pcurve);
  }
}

}  // namespace

bool repair_crossing_loops(ImportedShape& model, const ModelOfFile& tables, std::vector<ImportFinding>& findings) {
  const double exact = kHarmless * tables.tables.box().diagonal();
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(model.shape, TopAbs_EDGE, edges);
  bool is_changed = false;
  for (int f = 1; f <= model.faces.Extent(); ++f) {
    if (!tables.measures.crossing[f - 1]) continue;
    const TopoDS_Face face = TopoDS::Face(model.faces(f).Oriented(TopAbs_FORWARD));
    const std::vector<Change> changes = changes_of(face, exact);
    if (changes.empty() || !uncross(face, changes, exact)) continue;
    is_changed = true;
    for (const Change& c : changes)
      findings.push_back({FindingKind::kProjectedCurve, entity(edges.FindIndex(c.use.edge), f), c.gap.xyz,
                          c.gap.distance, true,
                          format_number(largest_gap(c.use, c.projected, kManySamples).distance / c.gap.distance)});
  }
  return is_changed;
}

void repair_pcurves(ImportedShape& model, std::vector<ImportFinding>& findings) {
  const double diagonal = model.box().diagonal();
  std::vector<std::uint8_t> leaves(model.faces.Extent(), 0);
  parallel_for(leaves.size(), 1, [&](std::size_t i, std::size_t) {
    visit_leaving(model.faces(static_cast<int>(i) + 1), diagonal,
                  [&](const Use&, const Handle(Geom2d_Curve)&) { leaves[i] = 1; });
  });
  const auto first = std::find(leaves.begin(), leaves.end(), 1);
  TopTools_IndexedMapOfShape edges;
  if (first != leaves.end()) TopExp::MapShapes(model.shape, TopAbs_EDGE, edges);
  for (auto f = static_cast<int>(first - leaves.begin()) + 1; f <= model.faces.Extent(); ++f)  // a repair changes
                                                                                               // others
    visit_leaving(model.faces(f), diagonal, [&](const Use& use, const Handle(Geom2d_Curve) & pcurve) {
      repair(use, pcurve, diagonal, entity(edges.FindIndex(use.edge), f), findings);
    });
}

}  // namespace st::occt
