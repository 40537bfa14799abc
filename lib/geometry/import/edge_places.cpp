#include "geometry/import/edge_places.h"

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Extrema_ExtPC.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <Geom_Curve.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Shell.hxx>
#include <algorithm>
#include <numeric>

#include "geometry/brep/shape_queries.h"

namespace st::occt {
namespace {

constexpr double kWhere = 1.0 / 3;  // of a free edge: a symmetric edge has its middle where others cross it

struct PlacedEdge {
  Handle(Geom_Curve) curve;
  double first = 0, last = 0;
  Box3 box;
  int piece = 0;
  bool is_free = false;
};

void collect(const TopoDS_Shape& shape, std::vector<TopoDS_Shape>& pieces) {
  for (TopoDS_Iterator child(shape); child.More(); child.Next()) {
    if (child.Value().ShapeType() < TopAbs_SOLID)
      collect(child.Value(), pieces);
    else if (child.Value().ShapeType() <= TopAbs_FACE)
      pieces.push_back(child.Value());
  }
}

std::vector<PlacedEdge> edges_of(const std::vector<TopoDS_Shape>& pieces) {
  std::vector<PlacedEdge> result;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    TopTools_IndexedMapOfShape edges;
    const std::vector<int> uses = edge_uses(pieces[p], edges);
    for (int i = 0; i < edges.Extent(); ++i) {
      const TopoDS_Edge edge = TopoDS::Edge(edges(i + 1));
      PlacedEdge e;
      if (!BRep_Tool::Degenerated(edge)) e.curve = BRep_Tool::Curve(edge, e.first, e.last);
      if (e.curve.IsNull()) continue;
      e.box = rough_box(edge);
      e.piece = static_cast<int>(p);
      e.is_free = uses[i] == 1;
      result.push_back(e);
    }
  }
  return result;
}

bool is_near(const Box3& box, Vec3 p, double tolerance) {
  return p.x >= box.lo.x - tolerance && p.x <= box.hi.x + tolerance && p.y >= box.lo.y - tolerance &&
         p.y <= box.hi.y + tolerance && p.z >= box.lo.z - tolerance && p.z <= box.hi.z + tolerance;
}

bool runs_through(const PlacedEdge& edge, const gp_Pnt& p, double tolerance) {
  try {
    const GeomAdaptor_Curve curve(edge.curve, edge.first, edge.last);
    const Extrema_ExtPC nearest(p, curve, edge.first, edge.last);
    for (int k = 1; nearest.IsDone() && k <= nearest.NbExt(); ++k)
      if (nearest.SquareDistance(k) <= tolerance * tolerance) return true;
  } catch (const Standard_Failure&) {
  }
  return false;
}

}  // namespace

std::vector<TopoDS_Shape> pieces_of(const TopoDS_Shape& shape) {
  std::vector<TopoDS_Shape> pieces;
  if (shape.ShapeType() < TopAbs_SOLID)
    collect(shape, pieces);
  else
    pieces.push_back(shape);
  return pieces;
}

std::vector<TopoDS_Shape> shells_of(const std::vector<TopoDS_Shape>& faces) {
  std::vector<int> shell(faces.size());
  std::iota(shell.begin(), shell.end(), 0);
  TopTools_IndexedMapOfShape edges;
  std::vector<int> owner;  // of each edge, the shell of the first face that has it
  for (std::size_t k = 0; k < faces.size(); ++k)
    for (TopExp_Explorer e(faces[k], TopAbs_EDGE); e.More(); e.Next()) {
      const std::size_t i = edges.Add(e.Current()) - 1;
      if (i == owner.size()) owner.push_back(shell[k]);
      const int from = std::max(owner[i], shell[k]), to = std::min(owner[i], shell[k]);
      for (std::vector<int>* list : {&shell, &owner}) std::replace(list->begin(), list->end(), from, to);
    }
  std::vector<TopoDS_Shape> result;
  for (int root = 0; root < static_cast<int>(faces.size()); ++root) {
    TopoDS_Shell members;
    BRep_Builder builder;
    builder.MakeShell(members);
    for (std::size_t k = 0; k < faces.size(); ++k)
      if (shell[k] == root) builder.Add(members, faces[k]);
    if (members.NbChildren() > 0) result.push_back(members);
  }
  return result;
}

std::vector<char> have_edges_at_one_place(const std::vector<TopoDS_Shape>& pieces, double tolerance) {
  std::vector<char> result(pieces.size(), 0);
  std::vector<PlacedEdge> edges = edges_of(pieces);
  std::stable_sort(edges.begin(), edges.end(),
                   [](const PlacedEdge& a, const PlacedEdge& b) { return a.box.lo.x < b.box.lo.x; });
  std::vector<char> is_open(pieces.size(), 0);
  for (const PlacedEdge& e : edges) is_open[e.piece] |= e.is_free;
  const auto may_join = [&](const PlacedEdge& a, const PlacedEdge& b) {
    return a.is_free || (a.piece != b.piece && is_open[b.piece]);
  };
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (!is_open[edges[i].piece]) continue;
    const gp_Pnt p = edges[i].curve->Value(edges[i].first + kWhere * (edges[i].last - edges[i].first));
    for (std::size_t k = 0; k < edges.size() && edges[k].box.lo.x <= p.X() + tolerance; ++k) {
      if (k == i || !may_join(edges[i], edges[k]) || !is_near(edges[k].box, vec(p), tolerance) ||
          !runs_through(edges[k], p, tolerance))
        continue;
      result[edges[i].piece] = result[edges[k].piece] = 1;
    }
  }
  return result;
}

}  // namespace st::occt
