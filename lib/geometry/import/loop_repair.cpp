#include "geometry/import/loop_repair.h"

#include <BRep_Builder.hxx>
#include <BRep_TEdge.hxx>
#include <BRep_TVertex.hxx>
#include <BRep_Tool.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Iterator.hxx>
#include <cmath>
#include <optional>

#include "base/boxes.h"
#include "base/threads.h"
#include "geometry/brep/occt_evaluators.h"
#include "geometry/brep/pcurve_fit.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/brep/wire_walk.h"
#include "geometry/import/import.h"
#include "geometry/model/sameness.h"
#include "geometry/shape/projection.h"

namespace st::occt {
namespace {

constexpr int kSamples = 33;
constexpr double kLost = 0.25;  // of the edge's length between edge and trimming curve: no matter of accuracy any more
constexpr double kRaised = 10;  // times what is needed: a tolerance that covers what is no more
constexpr double kAccurate = 1e-7;  // unit of the shape: OpenCASCADE's confusion

/// A use of an edge by a loop.
struct Use {
  TopoDS_Edge edge;
  CurveRange range;
  bool is_reversed = false;
  std::vector<Vec2> uv;         ///< [kSamples] along the curve, unwrapped, moved to where the loop needs it
  Handle(Geom2d_Curve) pcurve;  ///< once fitted
  Vec2 start() const { return is_reversed ? uv.back() : uv.front(); }
  Vec2 end() const { return is_reversed ? uv.front() : uv.back(); }
};

using LoopOfUses = std::vector<Use>;

/// A face being rebuilt.
struct Face {
  TopoDS_Face face;  ///< forward
  Handle(Geom_Surface) surface;
  Vec2 period;  ///< 0: none
  std::vector<LoopOfUses> loops;
  std::vector<std::pair<TopoDS_Wire, TopoDS_Edge>> poles;  ///< degenerate edges to leave out
};

double at(const CurveRange& r, int k) { return r.t0 + (r.t1 - r.t0) * k / (kSamples - 1); }

double chord_length(const CurveRange& r) {
  double length = 0;
  for (int k = 1; k < kSamples; ++k) length += r.curve->Value(at(r, k)).Distance(r.curve->Value(at(r, k - 1)));
  return length;
}

/// `point`: of the surface at a place in (u,v).
template <class Point>
double gap_to(const CurveRange& r, const Handle(Geom2d_Curve) & pcurve, const Point& point) {
  double gap = 0;
  for (int k = 0; k < kSamples; ++k)
    gap = std::max(gap, distance(vec(r.curve->Value(at(r, k))), point(pcurve->Value(at(r, k)))));
  return gap;
}
double gap_to(const CurveRange& r, const Handle(Geom_Surface) & surface, const Handle(Geom2d_Curve) & pcurve) {
  return gap_to(r, pcurve, [&](const gp_Pnt2d& uv) { return vec(surface->Value(uv.X(), uv.Y())); });
}

/// The trimming curve of a pole must be one point of the surface.
bool is_lost_pole(const TopoDS_Edge& edge, const TopoDS_Face& face, double harmless) {
  double t0, t1;
  const Handle(Geom2d_Curve) pcurve = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
  if (pcurve.IsNull()) return true;
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  const auto point = [&](double t) {
    const gp_Pnt2d uv = pcurve->Value(t);
    return surface->Value(uv.X(), uv.Y());
  };
  const double extent =
      std::max(point(t0).Distance(point(0.5 * (t0 + t1))), point(t0).Distance(point(0.7 * t0 + 0.3 * t1)));
  return extent > std::max({harmless, 10 * kAccurate});
}

/// Whether a loop passes all around a pole: without it, the loop would go on where it came from.
bool is_whole_pole(const TopoDS_Edge& edge, const TopoDS_Face& face, double harmless) {
  double t0, t1;
  const Handle(Geom2d_Curve) pcurve = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
  if (pcurve.IsNull() || is_lost_pole(edge, face, harmless)) return false;
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  return surface->IsUPeriodic() && std::abs(pcurve->Value(t1).X() - pcurve->Value(t0).X()) > 0.5 * surface->UPeriod();
}

/// `surface`: of the face.
bool is_lost_edge(const TopoDS_Edge& edge, const TopoDS_Face& face, const Surface& surface, double harmless) {
  if (BRep_Tool::Degenerated(edge)) return is_lost_pole(edge, face, harmless);
  double t0, t1;
  CurveRange r;
  const Handle(Geom2d_Curve) pcurve = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
  r.curve = BRep_Tool::Curve(edge, r.t0, r.t1);
  if (pcurve.IsNull() || r.curve.IsNull() || t0 != r.t0 || t1 != r.t1) return false;
  const double gap = gap_to(r, pcurve, [&](const gp_Pnt2d& uv) { return surface.point({uv.X(), uv.Y()}); });
  return gap > harmless && gap > kLost * chord_length(r);
}

bool is_lost(const TopoDS_Face& face, double harmless) {
  const Box2 bounds = uv_box(face);
  for (TopoDS_Iterator w(face); w.More(); w.Next())
    if (w.Value().ShapeType() == TopAbs_WIRE && !can_be_walked(TopoDS::Wire(w.Value()), face, bounds)) return true;
  const auto surface = make_surface(BRep_Tool::Surface(face));
  for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next())
    if (is_lost_edge(TopoDS::Edge(e.Current()), face, *surface, harmless)) return true;
  return false;
}

/// The uses of a wire from head to tail by their vertices; closed edges first where there is a choice. Empty when they
/// are not one ring.
LoopOfUses ring_of(std::vector<TopoDS_Edge> edges) {
  LoopOfUses ring;
  const auto is_closed = [](const TopoDS_Edge& e) { return TopExp::FirstVertex(e).IsSame(TopExp::LastVertex(e)); };
  const auto first = std::find_if_not(edges.begin(), edges.end(), is_closed);
  auto next = first == edges.end() ? edges.begin() : first;
  while (next != edges.end()) {
    Use use;
    use.edge = *next;
    use.is_reversed = next->Orientation() == TopAbs_REVERSED;
    use.range.curve = BRep_Tool::Curve(*next, use.range.t0, use.range.t1);
    if (use.range.curve.IsNull()) return {};
    ring.push_back(use);
    edges.erase(next);
    const TopoDS_Vertex head = TopExp::LastVertex(use.edge, true);
    const auto leaves = [&](const TopoDS_Edge& e) { return TopExp::FirstVertex(e, true).IsSame(head); };
    next = std::find_if(edges.begin(), edges.end(), [&](const TopoDS_Edge& e) { return leaves(e) && is_closed(e); });
    if (next == edges.end()) next = std::find_if(edges.begin(), edges.end(), leaves);
  }
  if (!edges.empty() || ring.empty()) return {};
  const bool is_ring = TopExp::LastVertex(ring.back().edge, true).IsSame(TopExp::FirstVertex(ring.front().edge, true));
  return is_ring ? ring : LoopOfUses();
}

/// False also where a pole would be lost.
bool collect_loops(Face& f, double harmless) {
  for (TopoDS_Iterator w(f.face); w.More(); w.Next()) {
    if (w.Value().ShapeType() != TopAbs_WIRE) return false;
    std::vector<TopoDS_Edge> edges;
    for (TopExp_Explorer e(w.Value(), TopAbs_EDGE); e.More(); e.Next()) {
      const TopoDS_Edge edge = TopoDS::Edge(e.Current());
      if (is_constraint(edge)) return false;
      if (BRep_Tool::Degenerated(edge) && is_whole_pole(edge, f.face, harmless)) return false;
      if (BRep_Tool::Degenerated(edge))
        f.poles.emplace_back(TopoDS::Wire(w.Value()), edge);
      else
        edges.push_back(edge);
    }
    f.loops.push_back(ring_of(edges));
    if (f.loops.back().empty()) return false;
  }
  return !f.loops.empty();
}

double to_nearest(double from, double to, double period) {
  return period > 0 ? period * std::round((to - from) / period) : 0.0;
}

/// The multiple of the periods that brings `from` nearest to `to`.
Vec2 periods_to(Vec2 from, Vec2 to, Vec2 period) {
  return {to_nearest(from.x, to.x, period.x), to_nearest(from.y, to.y, period.y)};
}

/// The foot of `p`, near the last one if there is one there. nullopt when the surface is elsewhere.
std::optional<Vec2> foot_of(const Surface& surface, Vec3 p, const std::optional<Vec2>& last, double tolerance) {
  if (last)
    if (const auto uv = project_near(surface, p, *last); uv && distance(surface.point(*uv), p) <= tolerance) return uv;
  const SurfaceFoot foot = closest_point(surface, p);
  if (!(foot.distance <= tolerance)) return std::nullopt;
  return foot.uv;
}

/// Projects the samples of an edge, without jumps across periods. False when the surface is elsewhere.
bool project(Use& use, const Surface& surface, Vec2 period, double tolerance) {
  std::optional<Vec2> last;
  for (int k = 0; k < kSamples; ++k) {
    last = foot_of(surface, vec(use.range.curve->Value(at(use.range, k))), last, tolerance);
    if (!last) return false;
    use.uv.push_back(*last + (use.uv.empty() ? Vec2{0, 0} : periods_to(*last, use.uv.back(), period)));
  }
  return true;
}

/// Moves the uses by whole periods so that each begins where the one before ends. False when it does not, or the loop
/// does not close.
bool join(LoopOfUses& loop, Vec2 period, double tolerance_uv) {
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec2 end = loop[(k + loop.size() - 1) % loop.size()].end();
    if (k > 0) {
      const Vec2 shift = periods_to(loop[k].start(), end, period);
      for (Vec2& uv : loop[k].uv) uv = uv + shift;
    }
  }
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec2 gap = loop[(k + 1) % loop.size()].start() - loop[k].end();
    if (std::abs(gap.x) > tolerance_uv || std::abs(gap.y) > tolerance_uv) return false;
  }
  return true;
}

double signed_area(const LoopOfUses& loop) {
  double area = 0;
  for (const Use& use : loop)
    for (int k = 1; k < kSamples; ++k)
      area += (use.is_reversed ? -0.5 : 0.5) * (use.uv[k - 1].x * use.uv[k].y - use.uv[k - 1].y * use.uv[k].x);
  return area;
}

void add_to(Box2& box, const LoopOfUses& loop) {
  for (const Use& use : loop)
    for (const Vec2& p : use.uv) box.add(p);
}

Box2 natural_bounds(const Face& f, double extent) {
  Box2 b;
  f.surface->Bounds(b.lo.x, b.hi.x, b.lo.y, b.hi.y);
  const auto limit = [&](double x) { return std::clamp(x, -extent, extent); };
  return {{limit(b.lo.x), limit(b.lo.y)}, {limit(b.hi.x), limit(b.hi.y)}};
}

/// Puts the holes into the period of the outer loop, all of them near the surface's own bounds. False when no loop is
/// the outer one.
bool place_loops(Face& f, const Box2& bounds) {
  std::size_t n_outer = 0;
  Box2 outer;
  for (const LoopOfUses& loop : f.loops)
    if (signed_area(loop) > 0) ++n_outer, add_to(outer, loop);
  if (n_outer != 1) return false;
  const Vec2 middle{0.5 * (bounds.lo.x + bounds.hi.x), 0.5 * (bounds.lo.y + bounds.hi.y)};
  const Vec2 target = outer.center() + periods_to(outer.center(), middle, f.period);
  for (LoopOfUses& loop : f.loops) {
    Box2 box;
    add_to(box, loop);
    const Vec2 shift = periods_to(box.center(), target, f.period);
    for (Use& use : loop)
      for (Vec2& uv : use.uv) uv = uv + shift;
  }
  return true;
}

/// Trimming curves through the samples. False when one cannot be made.
bool fit(Face& f, double tolerance) {
  Box2 box;
  for (const LoopOfUses& loop : f.loops) add_to(box, loop);
  const auto surface = make_surface(f.surface, box);
  for (LoopOfUses& loop : f.loops)
    for (Use& use : loop) {
      const auto guess = [&](double t) {
        const double s =
            std::clamp((t - use.range.t0) / (use.range.t1 - use.range.t0) * (kSamples - 1), 0.0, double(kSamples - 1));
        const int k = std::min(static_cast<int>(s), kSamples - 2);
        return use.uv[k] + (s - k) * (use.uv[k + 1] - use.uv[k]);
      };
      use.pcurve = fit_pcurve(use.range, *surface, guess, kAccurate);
      if (use.pcurve.IsNull() || gap_to(use.range, f.surface, use.pcurve) > tolerance) return false;
    }
  return true;
}

/// Loops in (u,v) from the space curves alone; nullopt when they cannot be made.
std::optional<Face> rebuilt(const TopoDS_Face& face, double harmless, double extent) {
  Face f;
  f.face = face;
  f.surface = BRep_Tool::Surface(face);
  const GeomAdaptor_Surface adaptor(f.surface);
  f.period = {adaptor.IsUPeriodic() ? adaptor.UPeriod() : 0.0, adaptor.IsVPeriodic() ? adaptor.VPeriod() : 0.0};
  if (!collect_loops(f, harmless)) return std::nullopt;
  const Box2 bounds = natural_bounds(f, extent);
  const auto surface = make_surface(f.surface, bounds);
  const double tolerance = std::max(10 * harmless, 100 * kAccurate);
  const double tolerance_uv = 1e-3 * std::max(f.period.x, f.period.y);
  for (LoopOfUses& loop : f.loops) {
    for (Use& use : loop)
      if (!project(use, *surface, f.period, tolerance)) return std::nullopt;
    if (!join(loop, f.period, tolerance_uv > 0 ? tolerance_uv : 1e-3 * (bounds.hi.x - bounds.lo.x)))
      return std::nullopt;
  }
  if (!place_loops(f, bounds) || !fit(f, tolerance)) return std::nullopt;
  return f;
}

/// Writes the trimming curves into the B-Rep and takes the poles out.
void apply(const Face& f) {
  BRep_Builder builder;
  for (auto [wire, pole] : f.poles) {
    wire.Free(true);
    builder.Remove(wire, pole);
  }
  for (const LoopOfUses& loop : f.loops)
    for (const Use& use : loop) {
      const auto partner = std::find_if(loop.begin(), loop.end(), [&](const Use& other) {
        return &other != &use && other.edge.IsSame(use.edge) && other.is_reversed != use.is_reversed;
      });
      const double gap = std::max(kAccurate, 1.01 * gap_to(use.range, f.surface, use.pcurve));
      Handle(BRep_TEdge)::DownCast(use.edge.TShape())->Tolerance(gap);
      const TopoDS_Edge edge = TopoDS::Edge(use.edge.Oriented(TopAbs_FORWARD));
      if (partner == loop.end())
        builder.UpdateEdge(edge, use.pcurve, f.face, gap);
      else
        builder.UpdateEdge(edge, use.is_reversed ? partner->pcurve : use.pcurve,
                           use.is_reversed ? use.pcurve : partner->pcurve, f.face, gap);
      builder.Range(edge, f.face, use.range.t0, use.range.t1);
    }
}

/// What a vertex needs to cover the ends of its edges, twice: ends may lie on both sides of it.
double needed_tolerance(const TopoDS_Vertex& vertex, const TopTools_ListOfShape& edges) {
  double tolerance = kAccurate;
  const gp_Pnt p = BRep_Tool::Pnt(vertex);
  for (const TopoDS_Shape& shape : edges) {
    const TopoDS_Edge edge = TopoDS::Edge(shape);
    double t0, t1;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, t0, t1);
    if (curve.IsNull()) continue;
    double nearest = 1e300;
    if (TopExp::FirstVertex(edge).IsSame(vertex)) nearest = std::min(nearest, p.Distance(curve->Value(t0)));
    if (TopExp::LastVertex(edge).IsSame(vertex)) nearest = std::min(nearest, p.Distance(curve->Value(t1)));
    tolerance = std::max({tolerance, BRep_Tool::Tolerance(edge), 2 * nearest});
  }
  return tolerance;
}

/// Vertices of the rebuilt faces lose the tolerances that the reader gave them.
void lower_vertex_tolerances(const TopoDS_Shape& shape, const std::vector<Face>& faces) {
  TopTools_IndexedDataMapOfShapeListOfShape edges_of;
  TopExp::MapShapesAndAncestors(shape, TopAbs_VERTEX, TopAbs_EDGE, edges_of);
  for (const Face& f : faces)
    for (TopExp_Explorer v(f.face, TopAbs_VERTEX); v.More(); v.Next()) {
      const TopoDS_Vertex vertex = TopoDS::Vertex(v.Current());
      if (!edges_of.Contains(vertex)) continue;
      const double needed = needed_tolerance(vertex, edges_of.FindFromKey(vertex));
      if (needed > BRep_Tool::Tolerance(vertex) || kRaised * needed < BRep_Tool::Tolerance(vertex))
        Handle(BRep_TVertex)::DownCast(vertex.TShape())->Tolerance(needed);
    }
}

/// OpenCASCADE walks a loop where its ends meet within the vertices' tolerances in (u,v); they are raised until it
/// does.
void make_walkable(const TopoDS_Face& face, double largest) {
  const auto is_walkable = [&] {
    bool all = true;
    for (TopoDS_Iterator w(face); w.More(); w.Next()) all &= can_be_walked(TopoDS::Wire(w.Value()), face);
    return all;
  };
  for (double tolerance = kRaised * kAccurate; tolerance <= largest && !is_walkable(); tolerance *= kRaised)
    for (TopExp_Explorer v(face, TopAbs_VERTEX); v.More(); v.Next())
      BRep_Builder().UpdateVertex(TopoDS::Vertex(v.Current()), tolerance);
}

TopoDS_Face forward_face(const ImportedShape& model, int i) {
  return TopoDS::Face(model.faces(i).Oriented(TopAbs_FORWARD));
}

}  // namespace

void rebuild_lost_loops(ImportedShape& model, std::vector<ImportFinding>& findings) {
  const double diagonal = model.box().diagonal(), harmless = kHarmless * diagonal;
  std::vector<int> numbers;  // of faces that may have lost loops, each shape once
  TopTools_MapOfShape seen;
  for (int i = 1; i <= model.faces.Extent(); ++i) {
    const TopoDS_Face face = forward_face(model, i);
    if (seen.Add(face.Located({})) && surface_type(BRep_Tool::Surface(face)) != SurfaceType::kPlane)
      numbers.push_back(i);
  }
  std::vector<std::uint8_t> lost(numbers.size(), 0);
  parallel_for(lost.size(), 1, [&](std::size_t k, std::size_t) {
    lost[k] = is_lost(forward_face(model, numbers[k]), harmless) ? 1 : 0;
  });
  std::vector<Face> faces;
  for (std::size_t k = 0; k < lost.size(); ++k) {
    const TopoDS_Face face = forward_face(model, numbers[k]);
    if (!(faces.empty() ? lost[k] != 0 : is_lost(face, harmless))) continue;  // repair changes edges of others
    const std::optional<Face> f = rebuilt(face, harmless, 100 * diagonal);
    if (!f) continue;
    apply(*f);
    faces.push_back(*f);
    const Box3 box = rough_box(face);
    findings.push_back(
        {FindingKind::kLostLoops, "face " + std::to_string(numbers[k]), box.center(), box.diagonal(), true});
  }
  if (faces.empty()) return;
  lower_vertex_tolerances(model.shape, faces);
  for (const Face& f : faces) make_walkable(f.face, 10 * harmless);
}

}  // namespace st::occt
