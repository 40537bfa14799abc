#include "geometry/import/rooms.h"

#include <BOPAlgo_MakerVolume.hxx>
#include <BRep_Builder.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <algorithm>

#include "geometry/brep/compound.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/import/edge_places.h"

namespace st::occt {
namespace {

bool has_third_face(const TopoDS_Shape& shell) {
  TopTools_IndexedMapOfShape edges;
  const std::vector<int> sides = edge_sides(shell, edges);
  return std::any_of(sides.begin(), sides.end(), [](int n) { return n > 2; });
}

/// Solids that OpenCASCADE finds between the faces, which have their edges in common; none where it fails.
std::vector<TopoDS_Shape> rooms_of(const TopoDS_Shape& shell) {
  try {
    TopTools_ListOfShape faces;
    for (TopExp_Explorer f(shell, TopAbs_FACE); f.More(); f.Next()) faces.Append(f.Current());
    BOPAlgo_MakerVolume maker;
    maker.SetArguments(faces);
    maker.SetIntersect(false);
    maker.SetAvoidInternalShapes(true);
    maker.Perform();
    std::vector<TopoDS_Shape> rooms;
    if (maker.HasErrors()) return rooms;
    for (TopExp_Explorer s(maker.Shape(), TopAbs_SOLID); s.More(); s.Next())
      if (count_free_edges(s.Current()) == 0) rooms.push_back(s.Current());
    return rooms;
  } catch (const Standard_Failure&) {
    return {};
  }
}

/// The solid with the faces of its shells in the order of the model.
TopoDS_Shape in_order(const TopoDS_Shape& solid, const TopTools_IndexedMapOfShape& order) {
  BRep_Builder builder;
  TopoDS_Solid result;
  builder.MakeSolid(result);
  for (TopExp_Explorer s(solid, TopAbs_SHELL); s.More(); s.Next()) {
    std::vector<TopoDS_Shape> faces;
    for (TopExp_Explorer f(s.Current(), TopAbs_FACE); f.More(); f.Next()) faces.push_back(f.Current());
    std::stable_sort(faces.begin(), faces.end(), [&](const TopoDS_Shape& a, const TopoDS_Shape& b) {
      return order.FindIndex(a) < order.FindIndex(b);
    });
    TopoDS_Shell shell;
    builder.MakeShell(shell);
    for (const TopoDS_Shape& face : faces) builder.Add(shell, face);
    shell.Closed(true);
    builder.Add(result, shell);
  }
  return result;
}

int first_face(const TopoDS_Shape& shape, const TopTools_IndexedMapOfShape& order) {
  int first = order.Extent() + 1;
  for (TopExp_Explorer f(shape, TopAbs_FACE); f.More(); f.Next()) first = std::min(first, order.FindIndex(f.Current()));
  return first;
}

/// Rooms, then sheets, of one shell; the shell itself where there is no room.
struct Division {
  std::vector<TopoDS_Shape> pieces;
  std::vector<TopoDS_Shape> rooms, sheets, walls;
};

Division divide(const TopoDS_Shape& shell, const TopTools_IndexedMapOfShape& order) {
  Division result;
  for (const TopoDS_Shape& room : rooms_of(shell)) result.rooms.push_back(in_order(room, order));
  if (result.rooms.empty()) {
    result.pieces.push_back(shell);
    return result;
  }
  std::stable_sort(result.rooms.begin(), result.rooms.end(), [&](const TopoDS_Shape& a, const TopoDS_Shape& b) {
    return first_face(a, order) < first_face(b, order);
  });
  std::vector<int> n_sides(order.Extent() + 1, 0);
  for (const TopoDS_Shape& room : result.rooms)
    for (TopExp_Explorer f(room, TopAbs_FACE); f.More(); f.Next()) ++n_sides[order.FindIndex(f.Current())];
  for (TopoDS_Iterator f(shell); f.More(); f.Next()) {
    const int n = n_sides[order.FindIndex(f.Value())];
    if (n == 0) result.sheets.push_back(f.Value());
    if (n > 1) result.walls.push_back(f.Value());
  }
  result.pieces = result.rooms;
  for (const TopoDS_Shape& loose : shells_of(result.sheets)) result.pieces.push_back(loose);
  return result;
}

ImportFinding finding(FindingKind kind, const ImportedShape& model, const TopoDS_Shape& shape) {
  const Box3 box = rough_box(shape);
  if (kind == FindingKind::kShellMadeSolid) return {kind, "", box.center(), box.diagonal(), true};
  const int id = model.faces.FindIndex(shape);
  const FaceAttributes& a = model.attributes[id - 1];
  const std::string& name = a.name.empty() ? a.part : a.name;
  std::string entity = "face " + std::to_string(id);
  if (!name.empty()) entity += " \"" + name + "\"";
  return {kind, entity, box.center(), box.diagonal(), false};
}

}  // namespace

void divide_into_rooms(ImportedShape& model, std::vector<ImportFinding>& findings) {
  std::vector<TopoDS_Shape> pieces;
  Division all;
  for (TopoDS_Iterator piece(model.shape); piece.More(); piece.Next()) {
    if (piece.Value().ShapeType() != TopAbs_SHELL || !has_third_face(piece.Value())) {
      pieces.push_back(piece.Value());
      continue;
    }
    const Division one = divide(piece.Value(), model.faces);
    for (const auto list : {&Division::rooms, &Division::sheets, &Division::walls})
      (all.*list).insert((all.*list).end(), (one.*list).begin(), (one.*list).end());
    pieces.insert(pieces.end(), one.pieces.begin(), one.pieces.end());
  }
  if (all.rooms.empty()) return;
  model.replace(compound_of(pieces), [](const TopoDS_Shape& face) { return face; });
  for (const TopoDS_Shape& s : all.rooms) findings.push_back(finding(FindingKind::kShellMadeSolid, model, s));
  for (const TopoDS_Shape& s : all.sheets) findings.push_back(finding(FindingKind::kSheet, model, s));
  for (const TopoDS_Shape& s : all.walls) findings.push_back(finding(FindingKind::kSharedWall, model, s));
}

}  // namespace st::occt
