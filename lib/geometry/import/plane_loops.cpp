#include "geometry/import/plane_loops.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepClass_FaceClassifier.hxx>
#include <BRepGProp.hxx>
#include <BRepLib.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <ShapeAnalysis_FreeBounds.hxx>
#include <ShapeFix_Shell.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_HSequenceOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shell.hxx>
#include <algorithm>
#include <cmath>

#include "base/disjoint_sets.h"
#include "geometry/brep/compound.h"
#include "geometry/brep/shape_queries.h"

namespace st::occt {
namespace {

constexpr int kPlacesShown = 5;

/// Bounded by `wires` whatever way they run: the first outside, the others holes.
TopoDS_Face planar_face(const gp_Pln& plane, const std::vector<TopoDS_Wire>& wires) {
  BRepBuilderAPI_MakeFace make(plane, wires[0], true);
  TopoDS_Face face = make.Face();
  for (std::size_t i = 1; i < wires.size(); ++i) {
    // MakeFace turns an outer wire that runs clockwise; a hole must run against it.
    const TopoDS_Face alone = BRepBuilderAPI_MakeFace(plane, wires[i], true).Face();
    const TopoDS_Shape turned = TopExp_Explorer(alone, TopAbs_WIRE).Current().Reversed();
    BRepBuilderAPI_MakeFace with_hole(face, TopoDS::Wire(turned));
    face = with_hole.Face();
  }
  return face;
}

/// A closed wire whose edges follow each other, or its parts that pass no vertex twice: a section that touches itself,
/// as that of a ring in a plane that touches its hole, is a figure of eight.
std::vector<TopoDS_Wire> simple_loops(const TopoDS_Wire& wire) {
  std::vector<TopoDS_Wire> loops;
  std::vector<TopoDS_Edge> path;
  for (TopExp_Explorer e(wire, TopAbs_EDGE); e.More(); e.Next()) {
    path.push_back(TopoDS::Edge(e.Current()));
    const TopoDS_Vertex end = TopExp::LastVertex(path.back(), true);
    const auto first = std::find_if(
        path.begin(), path.end(), [&](const TopoDS_Edge& edge) { return TopExp::FirstVertex(edge, true).IsSame(end); });
    if (first == path.end()) continue;
    BRep_Builder builder;
    TopoDS_Wire loop;
    builder.MakeWire(loop);
    for (auto edge = first; edge != path.end(); ++edge) builder.Add(loop, *edge);
    loop.Closed(true);
    loops.push_back(loop);
    path.erase(first, path.end());
  }
  return loops.size() > 1 && path.empty() ? loops : std::vector<TopoDS_Wire>{wire};
}

/// A point of `inner` in the face of `outer`.
bool contains(const PlaneLoop& outer, const PlaneLoop& inner) {
  return outer.area > inner.area && is_in(point_of(inner.wire), outer.face);
}

/// The shell with its faces in the order that they have in `faces`.
TopoDS_Shape in_order(const TopoDS_Shape& shell, const Faces& faces) {
  TopTools_IndexedMapOfShape own;
  TopExp::MapShapes(shell, TopAbs_FACE, own);
  TopoDS_Shell result;
  BRep_Builder builder;
  builder.MakeShell(result);
  for (const TopoDS_Face& f : faces)
    if (const int i = own.FindIndex(f); i > 0) builder.Add(result, own(i));
  return result;
}

}  // namespace

std::vector<TopoDS_Edge> free_edges(const Faces& faces) {
  TopTools_IndexedMapOfShape edges;
  const std::vector<int> uses = edge_uses(compound_of(faces), edges);
  std::vector<TopoDS_Edge> result;
  for (int i = 0; i < edges.Extent(); ++i)
    if (const TopoDS_Edge e = TopoDS::Edge(edges(i + 1)); uses[i] == 1 && !BRep_Tool::Degenerated(e))
      result.push_back(e);
  return result;
}

std::string places(const std::vector<TopoDS_Edge>& edges) {
  std::string text;
  for (std::size_t i = 0; i < edges.size() && i < kPlacesShown; ++i) {
    const BRepAdaptor_Curve curve(edges[i]);
    const gp_Pnt p = curve.Value(0.5 * (curve.FirstParameter() + curve.LastParameter()));
    text += (i ? ", (" : "(") + format_number(p.X()) + ", " + format_number(p.Y()) + ", " + format_number(p.Z()) + ")";
  }
  return text + (edges.size() > kPlacesShown ? " ..." : "");
}

double area_of(const TopoDS_Shape& shape) {
  GProp_GProps area;
  BRepGProp::SurfaceProperties(shape, area);
  return std::fabs(area.Mass());
}

double volume_of(const TopoDS_Shape& shape) {
  GProp_GProps volume;
  BRepGProp::VolumeProperties(shape, volume);
  return volume.Mass();
}

std::vector<TopoDS_Wire> simple_wires(const std::vector<TopoDS_Edge>& edges) {
  if (edges.empty()) return {};
  Handle(TopTools_HSequenceOfShape) sequence = new TopTools_HSequenceOfShape, wires;
  for (const TopoDS_Edge& e : edges) sequence->Append(e);
  ShapeAnalysis_FreeBounds::ConnectEdgesToWires(sequence, Precision::Confusion(), true, wires);
  std::vector<TopoDS_Wire> all;
  for (int i = 1; i <= wires->Length(); ++i)
    for (const TopoDS_Wire& loop : simple_loops(TopoDS::Wire(wires->Value(i)))) all.push_back(loop);
  return all;
}

std::optional<PlaneLoop> loop_in_plane(const TopoDS_Wire& wire, const gp_Pln& plane) {
  BRepBuilderAPI_MakeFace make(plane, wire, true);
  if (!BRep_Tool::IsClosed(wire) || !make.IsDone()) return std::nullopt;
  return PlaneLoop{wire, make.Face(), area_of(make.Face())};
}

std::vector<PlaneLoop> closed_loops(const std::vector<TopoDS_Edge>& edges, const gp_Pln& plane) {
  std::vector<PlaneLoop> loops;
  for (const TopoDS_Wire& wire : simple_wires(edges)) {
    std::optional<PlaneLoop> loop = loop_in_plane(wire, plane);
    if (!loop) return {};
    loops.push_back(*std::move(loop));
  }
  return loops;
}

gp_Pnt point_of(const TopoDS_Wire& wire) {
  const BRepAdaptor_Curve curve(TopoDS::Edge(TopExp_Explorer(wire, TopAbs_EDGE).Current()));
  return curve.Value(0.45 * curve.FirstParameter() + 0.55 * curve.LastParameter());
}

bool is_in(const gp_Pnt& p, const TopoDS_Face& face) {
  BRepClass_FaceClassifier classifier(face, p, Precision::Confusion());
  return classifier.State() == TopAbs_IN;
}

Faces faces_between(std::vector<PlaneLoop>& loops, const gp_Pln& plane) {
  for (PlaneLoop& loop : loops)
    for (std::size_t k = 0; k < loops.size(); ++k) {
      if (!contains(loops[k], loop)) continue;
      ++loop.depth;
      if (loop.container < 0 || loops[k].area < loops[loop.container].area) loop.container = static_cast<int>(k);
    }
  Faces faces;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (loops[i].depth % 2 == 1) continue;
    std::vector<TopoDS_Wire> wires{loops[i].wire};
    for (const PlaneLoop& hole : loops)
      if (hole.depth % 2 == 1 && hole.container == static_cast<int>(i)) wires.push_back(hole.wire);
    faces.push_back(planar_face(plane, wires));
    BRepLib::SameParameter(faces.back(), Precision::Confusion(), true);
  }
  return faces;
}

std::vector<TopoDS_Shape> shells_of(const Faces& faces) {
  DisjointSets sets(static_cast<std::int64_t>(faces.size()));
  TopTools_IndexedMapOfShape edges;
  std::vector<int> owner;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (TopExp_Explorer e(faces[f], TopAbs_EDGE); e.More(); e.Next()) {
      const std::size_t k = edges.Add(e.Current());
      if (k > owner.size()) owner.push_back(static_cast<int>(f));
      sets.join(owner[k - 1], static_cast<int>(f));
    }
  BRep_Builder builder;
  std::vector<TopoDS_Shape> result;
  for (const std::vector<int>& own : sets.groups()) {
    TopoDS_Shell shell;
    builder.MakeShell(shell);
    for (const int f : own) builder.Add(shell, faces[f]);
    ShapeFix_Shell fix;
    fix.FixFaceOrientation(shell);
    for (TopExp_Explorer e(fix.Shape(), TopAbs_SHELL); e.More(); e.Next())
      result.push_back(in_order(e.Current(), faces));
  }
  return result;
}

}  // namespace st::occt
