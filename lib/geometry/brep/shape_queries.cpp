#include "geometry/brep/shape_queries.h"

#include <BRepBndLib.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <cstddef>
#include <sstream>

#include "base/threads.h"

namespace st::occt {

namespace {

/// As BRepBndLib::Add() of the whole, but faces are on all threads.
Bnd_Box bnd_box(const TopoDS_Shape& shape) {
  constexpr std::size_t kAtOnce = 8;
  Bnd_Box all;
  std::vector<TopoDS_Shape> faces;
  for (TopExp_Explorer f(shape, TopAbs_FACE); f.More(); f.Next()) faces.push_back(f.Current());
  std::vector<Bnd_Box> boxes(faces.size());
  parallel_for(faces.size(), kAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) BRepBndLib::Add(faces[i], boxes[i], false);
  });
  for (const Bnd_Box& box : boxes) all.Add(box);
  for (TopExp_Explorer e(shape, TopAbs_EDGE, TopAbs_FACE); e.More(); e.Next()) BRepBndLib::Add(e.Current(), all, false);
  for (TopExp_Explorer v(shape, TopAbs_VERTEX, TopAbs_EDGE); v.More(); v.Next())
    BRepBndLib::Add(v.Current(), all, false);
  return all;
}

}  // namespace

Box3 rough_box(const TopoDS_Shape& shape) {
  const Bnd_Box box = bnd_box(shape);
  Box3 result;
  if (box.IsVoid()) return result;
  result.add(vec(box.CornerMin()));
  result.add(vec(box.CornerMax()));
  return result;
}

bool is_constraint(const TopoDS_Shape& edge) {
  return edge.Orientation() == TopAbs_INTERNAL || edge.Orientation() == TopAbs_EXTERNAL;
}

std::vector<int> edge_uses(const TopoDS_Shape& shape, TopTools_IndexedMapOfShape& edges) {
  edges.Clear();
  TopExp::MapShapes(shape, TopAbs_EDGE, edges);
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  std::vector<int> uses(edges.Extent(), 0);
  for (int f = 1; f <= faces.Extent(); ++f)
    for (TopExp_Explorer e(faces(f).Oriented(TopAbs_FORWARD), TopAbs_EDGE); e.More(); e.Next())
      if (!is_constraint(e.Current())) ++uses[edges.FindIndex(e.Current()) - 1];
  return uses;
}

std::vector<int> edge_sides(const TopoDS_Shape& shape, TopTools_IndexedMapOfShape& edges) {
  std::vector<int> sides = edge_uses(shape, edges);
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  for (int f = 1; f <= faces.Extent(); ++f)
    for (TopExp_Explorer e(faces(f).Oriented(TopAbs_FORWARD), TopAbs_EDGE); e.More(); e.Next())
      if (is_constraint(e.Current())) sides[edges.FindIndex(e.Current()) - 1] += 2;
  return sides;
}

int count_free_edges(const TopoDS_Shape& shape) {
  TopTools_IndexedMapOfShape edges;
  const std::vector<int> uses = edge_uses(shape, edges);
  int n = 0;
  for (int i = 0; i < edges.Extent(); ++i) n += uses[i] == 1 && !BRep_Tool::Degenerated(TopoDS::Edge(edges(i + 1)));
  return n;
}

std::string format_number(double x) {
  std::ostringstream s;
  s.precision(4);
  s << x;
  return s.str();
}

}  // namespace st::occt
