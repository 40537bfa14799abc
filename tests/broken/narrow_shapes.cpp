#include "broken/narrow_shapes.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <functional>
#include <gp_Pln.hxx>
#include <map>
#include <stdexcept>
#include <utility>

namespace st::test {
namespace {

/// A solid of plane faces that share vertices and edges.
class Polyhedron {
 public:
  explicit Polyhedron(const std::vector<gp_Pnt>& places) : places_(places) {
    for (const gp_Pnt& p : places) vertices_.push_back(BRepBuilderAPI_MakeVertex(p).Vertex());
    BRep_Builder().MakeShell(shell_);
  }

  /// The edge between two vertices is an arc through `middle`.
  void bend(int a, int b, gp_Pnt middle) {
    const auto arc = GC_MakeArcOfCircle(places_[a], middle, places_[b]).Value();
    edges_[{a, b}] = BRepBuilderAPI_MakeEdge(arc, vertices_[a], vertices_[b]).Edge();
  }

  /// Counter-clockwise as seen from outside; the first three places give the plane.
  void add_face(const std::vector<int>& corners) {
    const gp_Vec u(places_[corners[0]], places_[corners[1]]), v(places_[corners[0]], places_[corners[2]]);
    TopoDS_Face face = BRepBuilderAPI_MakeFace(gp_Pln(places_[corners[0]], u.Crossed(v))).Face();
    TopoDS_Wire wire;
    BRep_Builder().MakeWire(wire);
    for (std::size_t k = 0; k < corners.size(); ++k)
      BRep_Builder().Add(wire, edge(corners[k], corners[(k + 1) % corners.size()]));
    wire.Closed(true);
    BRep_Builder().Add(face, wire);
    BRep_Builder().Add(shell_, face);
  }

  TopoDS_Shape solid(double tolerance) {
    TopTools_IndexedMapOfShape edges;
    TopExp::MapShapes(shell_, TopAbs_EDGE, edges);
    for (int e = 1; e <= edges.Extent(); ++e) BRep_Builder().UpdateEdge(TopoDS::Edge(edges(e)), tolerance);
    for (const TopoDS_Vertex& v : vertices_) BRep_Builder().UpdateVertex(v, tolerance);
    shell_.Closed(true);
    TopoDS_Solid result;
    BRep_Builder().MakeSolid(result);
    BRep_Builder().Add(result, shell_);
    return result;
  }

 private:
  TopoDS_Edge edge(int a, int b) {
    if (const auto it = edges_.find({b, a}); it != edges_.end()) return TopoDS::Edge(it->second.Reversed());
    if (!edges_.contains({a, b})) edges_[{a, b}] = BRepBuilderAPI_MakeEdge(vertices_[a], vertices_[b]).Edge();
    return edges_[{a, b}];
  }

  std::vector<gp_Pnt> places_;
  std::vector<TopoDS_Vertex> vertices_;
  std::map<std::pair<int, int>, TopoDS_Edge> edges_;
  TopoDS_Shell shell_;
};

TopoDS_Shape wall_twice(double far) {
  constexpr double kHeight = 0.5;
  std::vector<gp_Pnt> places;
  for (const double z : {0., kHeight}) {
    const double beside = z > 0 ? far : -far;
    for (const auto& [x, y] : {std::pair{-5., 0.}, {0., 0.}, {0., 10.}, {-5., 10.}, {beside, 8.}, {5., 8.}, {5., 10.}})
      places.emplace_back(x, y, z);
  }
  Polyhedron solid(places);
  solid.bend(2, 9, {0, 9.8, 0.5 * kHeight});
  solid.add_face({0, 3, 2, 1});
  solid.add_face({4, 2, 6, 5});
  solid.add_face({7, 8, 9, 10});
  solid.add_face({11, 12, 13, 9});
  solid.add_face({0, 1, 8, 7});
  solid.add_face({3, 0, 7, 10});
  solid.add_face({13, 6, 2, 3, 10, 9});
  solid.add_face({5, 6, 13, 12});
  solid.add_face({4, 5, 12, 11});
  solid.add_face({8, 1, 2, 9});
  solid.add_face({11, 9, 2, 4});
  return solid.solid(0.001);
}

using Makers = std::map<std::string, std::function<TopoDS_Shape()>>;

Makers makers() {
  return {
      {"wall_apart", [] { return wall_twice(0.02); }},
      {"wall_twice", [] { return wall_twice(0.002); }},
  };
}

}  // namespace

std::vector<std::string> narrow_shapes() {
  std::vector<std::string> names;
  for (const auto& [name, maker] : makers()) names.push_back(name);
  return names;
}

void write_narrow(const std::string& name, const std::string& path) {
  const Makers all = makers();
  const auto maker = all.find(name);
  if (maker == all.end()) throw std::runtime_error("no narrow shape " + name);
  if (!BRepTools::Write(maker->second(), path.c_str())) throw std::runtime_error("cannot write " + path);
}

}  // namespace st::test
