#include "geometry/import/original_order.h"

#include <BRep_Builder.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Iterator.hxx>
#include <algorithm>
#include <utility>

#include "geometry/brep/compound.h"

namespace st::occt {
namespace {

/// The shell with its faces in ascending order of `rank(face)`.
template <class Rank>
TopoDS_Shape sorted_shell(const TopoDS_Shape& shell, const Rank& rank) {
  std::vector<std::pair<int, TopoDS_Shape>> members;
  for (TopoDS_Iterator f(shell, false, false); f.More(); f.Next())
    members.emplace_back(rank(f.Value().Located(shell.Location() * f.Value().Location())), f.Value());
  std::stable_sort(members.begin(), members.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  TopoDS_Shape ordered = shell.EmptyCopied();
  BRep_Builder builder;
  for (const auto& [first, face] : members) builder.Add(ordered, face);
  ordered.Closed(shell.Closed());
  return ordered;
}

}  // namespace

TopoDS_Shape in_original_order(const TopoDS_Shape& sewn, const std::vector<TopoDS_Shape>& images) {
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(sewn, TopAbs_FACE, faces);
  std::vector<int> first_original(faces.Extent(), 0);
  for (std::size_t i = 0; i < images.size(); ++i) first_original[faces.FindIndex(images[i]) - 1] = static_cast<int>(i);
  std::vector<std::pair<int, TopoDS_Shape>> pieces;  // and their first original
  TopTools_IndexedMapOfShape in_shell;
  for (TopExp_Explorer e(sewn, TopAbs_SHELL); e.More(); e.Next()) {
    TopTools_IndexedMapOfShape members;
    TopExp::MapShapes(e.Current(), TopAbs_FACE, members);
    int first = 1 << 30;
    for (int i = 1; i <= members.Extent(); ++i) {
      first = std::min(first, first_original[faces.FindIndex(members(i)) - 1]);
      in_shell.Add(members(i));
    }
    const TopoDS_Shape piece =
        sorted_shell(e.Current(), [&](const TopoDS_Shape& f) { return first_original[faces.FindIndex(f) - 1]; });
    pieces.emplace_back(first, piece);
  }
  for (int i = 1; i <= faces.Extent(); ++i)
    if (!in_shell.Contains(faces(i))) pieces.emplace_back(first_original[i - 1], faces(i));
  std::stable_sort(pieces.begin(), pieces.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<TopoDS_Shape> shapes;
  for (const auto& [first, piece] : pieces) shapes.push_back(piece);
  return compound_of(shapes);
}

}  // namespace st::occt
