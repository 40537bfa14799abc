#include "geometry/import/edge_spurs.h"

#include <BRepTools_ReShape.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <cmath>
#include <memory>

#include "geometry/brep/face_domain.h"
#include "geometry/brep/face_integral.h"
#include "geometry/brep/occt_evaluators.h"
#include "geometry/brep/pcurve_fit.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/brep/uv_box.h"
#include "geometry/brep/wire_walk.h"
#include "geometry/shape/projection.h"

namespace st::occt {
namespace {

constexpr int kAlong = 24;          // samples of an edge
constexpr double kBack = 0.5;       // of its length: how far the shorter one has to run along the longer one
constexpr double kRoom = 2;         // times the area between both edges: how much a face may change
constexpr double kMeasured = 1e-5;  // of the area: how exact integrals are

/// A curve in space and its length.
struct Arc {
  explicit Arc(const TopoDS_Edge& edge) {
    double t0, t1;
    const Handle(Geom_Curve) c = BRep_Tool::Curve(edge, t0, t1);
    if (!c.IsNull()) curve = make_curve(c, t0, t1), length = arc_length(*curve, t0, t1);
  }
  std::unique_ptr<Curve> curve;
  double length = 0;
};

Vec3 place_of(const TopoDS_Vertex& v) { return vec(BRep_Tool::Pnt(v)); }

/// Of samples of `a`; the largest distance from `b`.
double distance_along(const Curve& a, const Curve& b) {
  double largest = 0;
  for (int k = 0; k <= kAlong; ++k) {
    const double t = a.t_min() + (a.t_max() - a.t_min()) * k / kAlong;
    largest = std::max(largest, closest_point(b, a.point(t)).distance);
  }
  return largest;
}

/// `edge` between the vertex that is kept and `end`, which lies on it at the parameter `t`.
TopoDS_Edge cut_at(const TopoDS_Edge& edge, const TopoDS_Vertex& gone, const TopoDS_Vertex& end, double t, double gap) {
  const TopoDS_Edge forward = TopoDS::Edge(edge.Oriented(TopAbs_FORWARD));
  const bool is_last = TopExp::LastVertex(forward).IsSame(gone);
  double t0, t1;
  BRep_Tool::Range(forward, t0, t1);
  BRep_Builder builder;
  TopoDS_Edge rest = TopoDS::Edge(forward.EmptyCopied());
  builder.Add(rest, (is_last ? TopExp::FirstVertex(forward) : end).Oriented(TopAbs_FORWARD));
  builder.Add(rest, (is_last ? end : TopExp::LastVertex(forward)).Oriented(TopAbs_REVERSED));
  builder.Range(rest, is_last ? t0 : t, is_last ? t : t1);
  builder.UpdateVertex(end, gap);
  return TopoDS::Edge(rest.Oriented(edge.Orientation()));
}

/// `first` ends at `tip`, where `second` starts.
std::optional<EdgeSpur> spur_of(const TopoDS_Edge& first, const TopoDS_Edge& second, const TopoDS_Vertex& tip,
                                double within) {
  const Arc a(first), b(second);
  if (!a.curve || !b.curve || !BRep_Tool::SameRange(first) || !BRep_Tool::SameRange(second)) return std::nullopt;
  const bool first_is_shorter = a.length < b.length;
  const Arc &s = first_is_shorter ? a : b, &l = first_is_shorter ? b : a;
  EdgeSpur spur;
  spur.shorter = first_is_shorter ? first : second, spur.longer = first_is_shorter ? second : first;
  spur.gap = distance_along(*s.curve, *l.curve);
  if (spur.gap > within) return std::nullopt;
  const TopoDS_Vertex end = first_is_shorter ? TopExp::FirstVertex(first, true) : TopExp::LastVertex(second, true),
                      other = first_is_shorter ? TopExp::LastVertex(second, true) : TopExp::FirstVertex(first, true);
  if (end.IsSame(tip)) return std::nullopt;
  if (end.IsSame(other)) return spur;
  const CurveFoot foot = closest_point(*l.curve, place_of(end));
  const double t_tip = closest_point(*l.curve, place_of(tip)).t, t_other = closest_point(*l.curve, place_of(other)).t;
  if (std::abs(arc_length(*l.curve, foot.t, t_tip)) < std::max(within, kBack * s.length) ||
      std::abs(arc_length(*l.curve, foot.t, t_other)) < within)
    return std::nullopt;
  spur.rest = cut_at(spur.longer, tip, end, foot.t, foot.distance);
  return spur;
}

/// From head to tail; empty where the edges are no rings, or meet in a way that leaves a choice.
std::vector<EdgeChain> rings_of(EdgeChain left) {
  std::vector<EdgeChain> rings;
  while (!left.empty()) {
    EdgeChain ring{left.front()};
    left.erase(left.begin());
    const TopoDS_Vertex start = TopExp::FirstVertex(ring.front(), true);
    while (!TopExp::LastVertex(ring.back(), true).IsSame(start)) {
      const TopoDS_Vertex end = TopExp::LastVertex(ring.back(), true);
      const auto follows = [&](const TopoDS_Edge& e) { return TopExp::FirstVertex(e, true).IsSame(end); };
      const auto next = std::find_if(left.begin(), left.end(), follows);
      if (next == left.end() || std::count_if(left.begin(), left.end(), follows) > 1) return {};
      ring.push_back(*next);
      left.erase(next);
    }
    rings.push_back(std::move(ring));
  }
  return rings;
}

}  // namespace

std::vector<EdgeChain> chains_of(const TopoDS_Face& forward) {
  std::vector<EdgeChain> chains;
  for (TopoDS_Iterator w(forward); w.More(); w.Next()) {
    if (w.Value().ShapeType() != TopAbs_WIRE) continue;
    const TopoDS_Wire wire = TopoDS::Wire(w.Value());
    if (!can_be_walked(wire, forward)) return {};
    chains.push_back(walk_wire(wire, forward, uv_box(forward)));
  }
  return chains;
}

std::optional<TopoDS_Face> face_of_chains(const TopoDS_Face& face, const std::vector<EdgeChain>& chains, double area,
                                          double room) {
  BRep_Builder builder;
  TopoDS_Face result = TopoDS::Face(face.EmptyCopied());
  for (const EdgeChain& chain : chains)
    for (const EdgeChain& ring : rings_of(chain)) {
      TopoDS_Wire wire;
      builder.MakeWire(wire);
      for (const TopoDS_Edge& e : ring) builder.Add(wire, e);
      wire.Closed(true);
      builder.Add(result, wire);
      if (!can_be_walked(wire, result)) return std::nullopt;
    }
  if (!TopoDS_Iterator(result).More()) return std::nullopt;
  const double left = std::abs(integrate_face(make_domain(result), {}).area);
  return std::abs(left - area) <= room ? std::optional(result) : std::nullopt;
}

bool share_spur(const ImportedShape& model, const EdgeSpur& spur, const std::pair<FaceId, FaceId>& own,
                std::map<FaceId, TopoDS_Face>& faces) {
  for (FaceId f = 0; f < model.faces.Extent(); ++f) {
    if (f == own.first || f == own.second) continue;
    const auto it = faces.find(f);
    const TopoDS_Face face = it == faces.end() ? TopoDS::Face(model.faces(f + 1).Oriented(TopAbs_FORWARD)) : it->second;
    int n_uses = 0;
    for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) n_uses += e.Current().IsSame(spur.longer);
    if (n_uses == 0) continue;
    const auto changed = n_uses == 1 ? with_common_edge(face, spur) : std::nullopt;
    if (!changed) return false;
    faces[f] = *changed;
  }
  return true;
}

std::optional<EdgeSpur> find_spur(const std::vector<TopoDS_Edge>& loop, const std::vector<TopoDS_Edge>& added,
                                  double distance) {
  const auto is_added = [&](const TopoDS_Edge& edge) {
    return std::any_of(added.begin(), added.end(), [&](const TopoDS_Edge& e) { return e.IsSame(edge); });
  };
  for (const TopoDS_Edge& a : loop)
    for (const TopoDS_Edge& b : loop) {
      const TopoDS_Vertex tip = TopExp::LastVertex(a, true);
      if (a.IsSame(b) || !tip.IsSame(TopExp::FirstVertex(b, true)) || (!is_added(a) && !is_added(b))) continue;
      if (auto spur = spur_of(a, b, tip, distance)) return spur;
    }
  return std::nullopt;
}

std::vector<TopoDS_Edge> without_spur(std::vector<TopoDS_Edge> loop, const EdgeSpur& spur) {
  std::erase_if(loop, [&](const TopoDS_Edge& e) { return e.IsSame(spur.shorter) || e.IsSame(spur.longer); });
  if (!spur.rest.IsNull()) loop.push_back(spur.rest);
  return loop;
}

bool add_pcurve(const TopoDS_Edge& edge, const TopoDS_Face& face, double within) {
  double t0, t1;
  if (!BRep_Tool::CurveOnSurface(edge, face, t0, t1).IsNull()) return true;
  const auto surface = make_surface(BRep_Tool::Surface(face), uv_box(face));
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, t0, t1);
  const double tolerance = BRep_Tool::Tolerance(edge);
  const Handle(Geom2d_Curve) pcurve = fit_pcurve(
      {curve, t0, t1}, *surface, [&](double t) { return closest_point(*surface, vec(curve->Value(t))).uv; },
      0.5 * tolerance);
  if (pcurve.IsNull()) return false;
  double gap = 0;
  for (int k = 0; k <= kAlong; ++k) {
    const double t = t0 + (t1 - t0) * k / kAlong;
    const gp_Pnt2d uv = pcurve->Value(t);
    gap = std::max(gap, distance(vec(curve->Value(t)), surface->point({uv.X(), uv.Y()})));
  }
  if (gap > within) return false;
  BRep_Builder builder;
  builder.UpdateEdge(edge, pcurve, face, std::max(tolerance, gap));
  builder.Range(edge, face, t0, t1);
  for (TopExp_Explorer v(edge, TopAbs_VERTEX); v.More(); v.Next())
    builder.UpdateVertex(TopoDS::Vertex(v.Current()), gap);
  return true;
}

std::optional<TopoDS_Face> with_common_edge(const TopoDS_Face& face, const EdgeSpur& spur) {
  const double room = kRoom * spur.gap * Arc(spur.shorter).length;
  if (!add_pcurve(spur.shorter, face, kRoom * spur.gap + BRep_Tool::Tolerance(spur.shorter))) return std::nullopt;
  const bool is_forward = spur.longer.Orientation() == TopAbs_FORWARD;
  BRep_Builder builder;
  TopoDS_Compound pieces;  // as the longer edge runs when forward
  builder.MakeCompound(pieces);
  if (!spur.rest.IsNull()) builder.Add(pieces, spur.rest.Oriented(TopAbs_FORWARD));
  builder.Add(pieces, is_forward ? spur.shorter.Reversed() : TopoDS_Shape(spur.shorter));
  const Handle(BRepTools_ReShape) reshape = new BRepTools_ReShape;
  reshape->Replace(spur.longer.Oriented(TopAbs_FORWARD), pieces);
  const TopoDS_Shape changed = reshape->Apply(face);
  if (changed.IsNull() || changed.ShapeType() != TopAbs_FACE) return std::nullopt;
  const TopoDS_Face result = TopoDS::Face(changed);
  for (TopoDS_Iterator w(result); w.More(); w.Next())
    if (w.Value().ShapeType() == TopAbs_WIRE && !can_be_walked(TopoDS::Wire(w.Value()), result)) return std::nullopt;
  const double before = std::abs(integrate_face(make_domain(face), {}).area),
               after = std::abs(integrate_face(make_domain(result), {}).area);
  return std::abs(after - before) <= room + kMeasured * before ? std::optional(result) : std::nullopt;
}

}  // namespace st::occt
