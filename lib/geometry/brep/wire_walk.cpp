#include "geometry/brep/wire_walk.h"

#include <BRepTools_WireExplorer.hxx>
#include <BRep_Tool.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>

#include "geometry/brep/shape_queries.h"

namespace st::occt {
namespace {

constexpr double kAsFar = 0.1;  // of the range of the face in (u,v): less than the period that a wrong order jumps

std::vector<TopoDS_Edge> stored_edges(const TopoDS_Wire& wire) {
  std::vector<TopoDS_Edge> edges;
  for (TopExp_Explorer e(wire, TopAbs_EDGE); e.More(); e.Next())
    if (!is_constraint(e.Current())) edges.push_back(TopoDS::Edge(e.Current()));
  return edges;
}

/// The start or end of an edge in (u,v), as it runs.
gp_Pnt2d end_of(const TopoDS_Edge& edge, const TopoDS_Face& face, bool is_end) {
  gp_Pnt2d first, last;
  BRep_Tool::UVPoints(edge, face, first, last);  // by its parameters
  return is_end == (edge.Orientation() != TopAbs_REVERSED) ? last : first;
}

/// Whether each edge starts where the one before ends.
bool is_ring(const std::vector<TopoDS_Edge>& edges, const TopoDS_Face& face, const Vec2& extent) {
  const auto after = [&](std::size_t k) -> const TopoDS_Edge& { return edges[(k + 1) % edges.size()]; };
  for (std::size_t k = 0; k < edges.size(); ++k)
    if (!TopExp::LastVertex(edges[k], true).IsSame(TopExp::FirstVertex(after(k), true))) return false;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const TopoDS_Edge &edge = edges[k], &next = after(k);
    const gp_Pnt2d end = end_of(edge, face, true), next_start = end_of(next, face, false);
    if (std::fabs(end.X() - next_start.X()) > kAsFar * extent.x) return false;
    if (std::fabs(end.Y() - next_start.Y()) > kAsFar * extent.y) return false;
  }
  return true;
}

}  // namespace

std::vector<TopoDS_Edge> walk_wire(const TopoDS_Wire& wire, const TopoDS_Face& face, const Box2& bounds) {
  std::vector<TopoDS_Edge> stored = stored_edges(wire), walked;
  BRepTools_WireExplorer e;
  for (e.Init(wire, face, bounds.lo.x, bounds.hi.x, bounds.lo.y, bounds.hi.y); e.More(); e.Next())
    if (!is_constraint(e.Current())) walked.push_back(e.Current());
  if (walked.size() == stored.size()) return walked;
  if (is_ring(stored, face, bounds.size())) return stored;
  std::reverse(stored.begin(), stored.end());
  return is_ring(stored, face, bounds.size()) ? stored : walked;
}

bool can_be_walked(const TopoDS_Wire& wire, const TopoDS_Face& face, const Box2& bounds) {
  const std::vector<TopoDS_Edge> stored = stored_edges(wire);
  if (is_ring(stored, face, bounds.size())) return true;  // found sooner
  return walk_wire(wire, face, bounds).size() == stored.size();
}

}  // namespace st::occt
