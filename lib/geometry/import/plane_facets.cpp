#include "geometry/import/plane_facets.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Tool.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/predicates.h"
#include "geometry/import/plane_loops.h"

namespace st {
namespace {

using Side = std::pair<std::int32_t, std::int32_t>;

constexpr double kShortest = 1e-3;  // OpenCASCADE's points are one within 1e-7: what the shortest side becomes
constexpr double kCoarse = 1e9;     // deflection: no node but those given

/// The wires' edges, and what they are of.
struct Outline {
  std::vector<TopoDS_Vertex> vertices;     // of the used nodes
  std::map<std::int32_t, std::size_t> at;  // their rows
  std::vector<TopoDS_Edge> edges;          // [sides]
};

Outline outline_of(std::span<const Vec2> x, std::span<const Side> sides) {
  double shortest = std::numeric_limits<double>::max();
  for (const auto& [a, b] : sides) shortest = std::min(shortest, norm(x[b] - x[a]));
  const double scale = std::max(1.0, kShortest / shortest);
  Outline o;
  const auto vertex = [&](std::int32_t node) {
    const auto [it, is_new] = o.at.try_emplace(node, o.vertices.size());
    if (is_new) o.vertices.push_back(BRepBuilderAPI_MakeVertex(gp_Pnt(scale * x[node].x, scale * x[node].y, 0)));
    return o.vertices[it->second];
  };
  for (const auto& [a, b] : sides) {
    const TopoDS_Vertex from = vertex(a), to = vertex(b);
    BRepBuilderAPI_MakeEdge make(from, to);
    if (!make.IsDone()) return {};
    o.edges.push_back(make.Edge());
  }
  return o;
}

/// Nodes of the triangulation of a face that are ends of the outline's edges: node of the polygons; kNone: none.
std::vector<std::int32_t> nodes_of(const occt::Faces::value_type& face, const Handle(Poly_Triangulation) & facets,
                                   const TopLoc_Location& place, const Outline& outline) {
  TopTools_IndexedMapOfShape vertices, edges;
  for (const TopoDS_Vertex& v : outline.vertices) vertices.Add(v);
  std::vector<std::int32_t> node_of_row(outline.vertices.size());
  for (const auto& [node, row] : outline.at) node_of_row[row] = node;
  std::vector<std::int32_t> node(static_cast<std::size_t>(facets->NbNodes()), kNone);
  TopExp::MapShapes(face, TopAbs_EDGE, edges);
  for (int i = 1; i <= edges.Extent(); ++i) {
    const TopoDS_Edge edge = TopoDS::Edge(edges(i));
    const Handle(Poly_PolygonOnTriangulation) polygon = BRep_Tool::PolygonOnTriangulation(edge, facets, place);
    if (polygon.IsNull()) continue;
    const TopoDS_Shape forward = edge.Oriented(TopAbs_FORWARD);
    const TopoDS_Vertex ends[] = {TopExp::FirstVertex(TopoDS::Edge(forward)),
                                  TopExp::LastVertex(TopoDS::Edge(forward))};
    const int rows[] = {polygon->Node(1), polygon->Node(polygon->NbNodes())};
    for (int k = 0; k < 2; ++k)
      if (const int v = vertices.FindIndex(ends[k]); v > 0) node[rows[k] - 1] = node_of_row[v - 1];
  }
  return node;
}

/// Appends the triangles of a face; false where it has none, or has other nodes than those of the polygons.
bool append(const TopoDS_Face& face, const Outline& outline, std::span<const Vec2> x, std::vector<Corners>& all) {
  BRepMesh_IncrementalMesh mesher(face, kCoarse);
  TopLoc_Location place;
  const Handle(Poly_Triangulation) facets = BRep_Tool::Triangulation(face, place);
  if (facets.IsNull()) return false;
  const std::vector<std::int32_t> node = nodes_of(face, facets, place, outline);
  for (int t = 1; t <= facets->NbTriangles(); ++t) {
    Corners c{};
    facets->Triangle(t).Get(c[0], c[1], c[2]);
    for (std::int32_t& corner : c)
      if ((corner = node[corner - 1]) == kNone) return false;
    if (orient2d(x[c[0]], x[c[1]], x[c[2]]) < 0) std::swap(c[1], c[2]);
    all.push_back(c);
  }
  return true;
}

/// Each side of the polygons bounds one triangle, all other sides two that lie on both sides of them.
bool fills(const std::vector<Corners>& triangles, std::span<const Side> sides) {
  std::map<Side, int> uses;
  for (const Corners& c : triangles)
    for (int k = 0; k < 3; ++k)
      if (++uses[{c[k], c[(k + 1) % 3]}] > 1) return false;
  std::size_t n_rim = 0;
  for (const auto& [side, count] : uses) n_rim += uses.count({side.second, side.first}) == 0;
  return n_rim == sides.size() && std::all_of(sides.begin(), sides.end(), [&](const Side& s) {
           return uses.count(s) + uses.count({s.second, s.first}) == 1;
         });
}

}  // namespace

std::optional<std::vector<Corners>> facets_between(std::span<const Vec2> x, std::span<const Side> sides) {
  const Outline outline = outline_of(x, sides);
  std::vector<occt::PlaneLoop> loops = occt::closed_loops(outline.edges, gp_Pln());
  if (loops.empty()) return std::nullopt;
  std::vector<Corners> triangles;
  for (const TopoDS_Face& face : occt::faces_between(loops, gp_Pln()))
    if (!append(face, outline, x, triangles)) return std::nullopt;
  if (!fills(triangles, sides)) return std::nullopt;
  for (const Corners& c : triangles)
    if (!(orient2d(x[c[0]], x[c[1]], x[c[2]]) > 0)) return std::nullopt;
  return triangles;
}

}  // namespace st
