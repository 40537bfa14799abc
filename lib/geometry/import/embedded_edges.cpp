#include "geometry/import/embedded_edges.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/import/import.h"

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>

namespace st::occt {
namespace {

/// Edges that bound a face somewhere.
TopTools_MapOfShape bounding_edges(const ImportedShape& model) {
  TopTools_MapOfShape result;
  for (int f = 1; f <= model.faces.Extent(); ++f)
    for (TopExp_Explorer e(model.faces(f).Oriented(TopAbs_FORWARD), TopAbs_EDGE); e.More(); e.Next())
      if (!is_constraint(e.Current())) result.Add(e.Current());
  return result;
}

/// Takes the INTERNAL edges of a face that are in `bounding` out of its wires.
std::vector<TopoDS_Edge> take_out(const TopoDS_Face& face, const TopTools_MapOfShape& bounding) {
  std::vector<std::pair<TopoDS_Wire, TopoDS_Edge>> found;
  for (TopoDS_Iterator w(face); w.More(); w.Next()) {
    if (w.Value().ShapeType() != TopAbs_WIRE) continue;
    for (TopoDS_Iterator e(w.Value()); e.More(); e.Next())
      if (e.Value().Orientation() == TopAbs_INTERNAL && bounding.Contains(e.Value()) &&
          !BRep_Tool::Degenerated(TopoDS::Edge(e.Value())))
        found.emplace_back(TopoDS::Wire(w.Value()), TopoDS::Edge(e.Value()));
  }
  BRep_Builder builder;
  std::vector<TopoDS_Edge> edges;
  for (auto& [wire, edge] : found) {
    wire.Free(true);
    builder.Remove(wire, edge);
    edges.push_back(TopoDS::Edge(edge.Oriented(TopAbs_FORWARD)));
  }
  return edges;
}

/// Adds to `wire` every edge of `left` that can be reached from `vertex` without a ring, there and back.
void walk(const TopoDS_Vertex& vertex, std::vector<TopoDS_Edge>& left, TopTools_MapOfShape& visited,
          TopoDS_Wire& wire) {
  visited.Add(vertex);
  for (std::size_t k = 0; k < left.size();) {
    const bool from_first = TopExp::FirstVertex(left[k]).IsSame(vertex),
               from_last = TopExp::LastVertex(left[k]).IsSame(vertex);
    const TopoDS_Vertex next = from_first ? TopExp::LastVertex(left[k]) : TopExp::FirstVertex(left[k]);
    if (from_first == from_last || visited.Contains(next)) {
      ++k;
      continue;
    }
    const TopoDS_Shape there = left[k].Oriented(from_first ? TopAbs_FORWARD : TopAbs_REVERSED);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
    BRep_Builder().Add(wire, there);
    walk(next, left, visited, wire);
    BRep_Builder().Add(wire, there.Reversed());
    k = 0;
  }
}

/// One wire per tree of edges; edges that close rings are left over.
std::vector<TopoDS_Wire> slits_of(std::vector<TopoDS_Edge> left) {
  std::vector<TopoDS_Wire> slits;
  while (!left.empty()) {
    TopoDS_Wire wire;
    BRep_Builder().MakeWire(wire);
    TopTools_MapOfShape visited;
    const std::size_t before = left.size();
    walk(TopExp::FirstVertex(left.front()), left, visited, wire);
    if (left.size() == before) {
      left.erase(left.begin());
      continue;
    }
    slits.push_back(wire);
  }
  return slits;
}

void remove_empty_wires(TopoDS_Face face) {
  std::vector<TopoDS_Shape> empty;
  for (TopoDS_Iterator w(face); w.More(); w.Next())
    if (w.Value().ShapeType() == TopAbs_WIRE && !TopoDS_Iterator(w.Value()).More()) empty.push_back(w.Value());
  for (const TopoDS_Shape& wire : empty) BRep_Builder().Remove(face, wire);
}

}  // namespace

void open_slits(ImportedShape& model, std::vector<ImportFinding>& findings) {
  const TopTools_MapOfShape bounding = bounding_edges(model);
  TopTools_MapOfShape seen;
  for (int i = 1; i <= model.faces.Extent(); ++i) {
    TopoDS_Face face = TopoDS::Face(model.faces(i).Oriented(TopAbs_FORWARD));
    if (!seen.Add(face.Located({}))) continue;
    const std::vector<TopoDS_Edge> edges = take_out(face, bounding);
    if (edges.empty()) continue;
    face.Free(true);
    for (const TopoDS_Wire& slit : slits_of(edges)) BRep_Builder().Add(face, slit);
    remove_empty_wires(face);
    findings.push_back({FindingKind::kSlit, "face " + std::to_string(i),
                        vec(BRep_Tool::Pnt(TopExp::FirstVertex(edges.front()))), rough_box(face).diagonal(), true});
  }
}

}  // namespace st::occt
