#include "geometry/import/ring_edges.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <vector>

#include "base/vec.h"
#include "geometry/brep/replace_children.h"

namespace st::occt {
namespace {

constexpr double kFarAway = 100;  // of the precision: the middle of a ring from its ends
constexpr double kGap = 1e-7;     // of that way: ends are one point whatever the precision, as digits in files end
constexpr double kMeets = 1e-3;   // of the ring's way in (u,v): to the edges before and after it

/// By the curve in space, else on the surface; 0: it has neither.
double way_to_middle(const TopoDS_Edge& edge, const gp_Pnt& end) {
  if (BRep_Tool::Degenerated(edge) || !BRep_Tool::IsGeometric(edge)) return 0;
  const BRepAdaptor_Curve curve(edge);
  return curve.Value(0.5 * (curve.FirstParameter() + curve.LastParameter())).Distance(end);
}

void replace_vertex(const TopoDS_Edge& edge, const TopoDS_Vertex& was, const TopoDS_Vertex& now) {
  std::vector<TopoDS_Shape> old, fresh;
  for (TopoDS_Iterator v(edge, false, false); v.More(); v.Next()) {
    if (!v.Value().IsSame(was)) continue;
    old.push_back(v.Value());
    fresh.push_back(now.Oriented(v.Value().Orientation()));
  }
  if (!old.empty()) replace_children(edge, old, fresh);
}

/// An edge of a loop and its ends in (u,v), as the loop passes it.
struct Passed {
  TopoDS_Shape edge;
  bool is_ring = false;
  Vec2 start = {}, end = {};
};

/// Rings that meet the edges before and after them in (u,v) the other way round alone.
std::vector<Passed> with_rings_turned(const TopoDS_Shape& wire, const TopoDS_Face& face,
                                      const TopTools_IndexedMapOfShape& rings, int& n) {
  std::vector<Passed> loop;
  for (TopoDS_Iterator e(wire, false, false); e.More(); e.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(e.Value());
    double t0, t1;
    const Handle(Geom2d_Curve) pcurve = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
    if (pcurve.IsNull()) return {};
    const gp_Pnt2d a = pcurve->Value(t0), b = pcurve->Value(t1);
    loop.push_back({edge, rings.Contains(edge), {a.X(), a.Y()}, {b.X(), b.Y()}});
    if (edge.Orientation() == TopAbs_REVERSED) std::swap(loop.back().start, loop.back().end);
  }
  for (std::size_t i = 0; i < loop.size(); ++i) {
    Passed& own = loop[i];
    const Vec2 before = loop[(i + loop.size() - 1) % loop.size()].end, after = loop[(i + 1) % loop.size()].start;
    const double near = kMeets * norm(own.end - own.start);
    const bool meets = norm(before - own.start) <= near && norm(after - own.end) <= near;
    if (!own.is_ring || meets || norm(before - own.end) > near || norm(after - own.start) > near) continue;
    own.edge.Reverse();
    std::swap(own.start, own.end);
    ++n;
  }
  return loop;
}

void turn_rings(const TopoDS_Face& face, const TopTools_IndexedMapOfShape& rings) {
  std::vector<TopoDS_Shape> wires;
  for (TopoDS_Iterator w(face, false, false); w.More(); w.Next())
    if (w.Value().ShapeType() == TopAbs_WIRE) wires.push_back(w.Value().Oriented(TopAbs_FORWARD));
  for (const TopoDS_Shape& wire : wires) {
    int n = 0;
    std::vector<TopoDS_Shape> old, fresh;
    for (TopoDS_Iterator e(wire, false, false); e.More(); e.Next()) old.push_back(e.Value());
    for (const Passed& passed : with_rings_turned(wire, face, rings, n)) fresh.push_back(passed.edge);
    if (n > 0) replace_children(wire, old, fresh);
  }
}

}  // namespace

int join_ring_ends(std::span<const TopoDS_Face> faces, double precision) {
  int n = 0;
  for (const TopoDS_Face& face : faces) {
    TopTools_IndexedMapOfShape edges, rings;
    TopExp::MapShapes(face, TopAbs_EDGE, edges);
    for (int e = 1; e <= edges.Extent(); ++e) {
      const TopoDS_Edge edge = TopoDS::Edge(edges(e).Oriented(TopAbs_FORWARD));
      TopoDS_Vertex first, last;
      TopExp::Vertices(edge, first, last);
      if (first.IsNull() || last.IsNull() || first.IsSame(last)) continue;
      const gp_Pnt begin = BRep_Tool::Pnt(first);
      const double gap = begin.Distance(BRep_Tool::Pnt(last)), way = way_to_middle(edge, begin);
      if (gap > std::max(precision, kGap * way) || way <= kFarAway * precision) continue;
      BRep_Builder().UpdateVertex(first, gap + BRep_Tool::Tolerance(last));
      for (int k = 1; k <= edges.Extent(); ++k) replace_vertex(TopoDS::Edge(edges(k)), last, first);
      rings.Add(edge);
      ++n;
    }
    if (!rings.IsEmpty()) turn_rings(face, rings);
  }
  return n;
}

}  // namespace st::occt
