#include "geometry/sewing.h"

#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepLib.hxx>
#include <BRep_Builder.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Iterator.hxx>

namespace st::occt {
namespace {

constexpr double kSewRelative[] = {1e-6, 1e-5, 1e-4};  // of the diagonal, first that closes the model wins

/// Face of the sewn shape that stands for a face of old.
TopoDS_Shape image_of(const BRepBuilderAPI_Sewing& sewing, const TopoDS_Shape& face) {
  return sewing.IsModifiedSubShape(face) ? sewing.ModifiedSubShape(face) : face;
}

bool keeps_faces(const BRepBuilderAPI_Sewing& sewing, const TopoDS_Shape& sewn, const TopTools_IndexedMapOfShape& originals) {
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(sewn, TopAbs_FACE, faces);
  if (faces.Extent() != originals.Extent()) return false;
  for (int i = 1; i <= originals.Extent(); ++i)
    if (!faces.Contains(image_of(sewing, originals(i)))) return false;
  return true;
}

/// The shell with its faces in ascending order of `rank(face)`.
template <class Rank>
TopoDS_Shape in_original_order(const TopoDS_Shape& shell, const Rank& rank) {
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

TopoDS_Shape outward_solid(const TopoDS_Shell& shell) {
  try {
    BRepBuilderAPI_MakeSolid maker(shell);
    if (!maker.IsDone()) return shell;
    TopoDS_Solid solid = maker.Solid();
    BRepLib::OrientClosedSolid(solid);
    return solid;
  } catch (const Standard_Failure&) {
    return shell;
  }
}

/// Sewing permutes faces and drops solids: shells and faces in the order of their first original face, closed shells as outward solids.
TopoDS_Shape ordered_solids(const TopoDS_Shape& sewn, const std::vector<TopoDS_Shape>& images) {
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(sewn, TopAbs_FACE, faces);
  std::vector<int> first_original(faces.Extent(), 0);
  for (std::size_t i = 0; i < images.size(); ++i) first_original[faces.FindIndex(images[i]) - 1] = static_cast<int>(i);
  struct Piece {
    int first;
    TopoDS_Shape shape;
  };
  std::vector<Piece> pieces;
  TopTools_IndexedMapOfShape in_shell;
  for (TopExp_Explorer e(sewn, TopAbs_SHELL); e.More(); e.Next()) {
    TopTools_IndexedMapOfShape members;
    TopExp::MapShapes(e.Current(), TopAbs_FACE, members);
    int first = 1 << 30;
    for (int i = 1; i <= members.Extent(); ++i) {
      first = std::min(first, first_original[faces.FindIndex(members(i)) - 1]);
      in_shell.Add(members(i));
    }
    TopoDS_Shape piece = in_original_order(e.Current(), [&](const TopoDS_Shape& f) { return first_original[faces.FindIndex(f) - 1]; });
    if (count_free_edges(piece) == 0) piece = outward_solid(TopoDS::Shell(piece));
    pieces.push_back({first, piece});
  }
  for (int i = 1; i <= faces.Extent(); ++i)
    if (!in_shell.Contains(faces(i))) pieces.push_back({first_original[i - 1], faces(i)});
  std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.first < b.first; });
  BRep_Builder builder;
  TopoDS_Compound compound;
  builder.MakeCompound(compound);
  for (const Piece& p : pieces) builder.Add(compound, p.shape);
  return compound;
}

}  // namespace

void sew_if_open(ImportedShape& model, double stated_resolution, std::vector<ImportFinding>& findings) {
  int best_free = count_free_edges(model.shape);
  if (best_free == 0) return;
  const int free_before = best_free;
  const double diagonal = rough_box(model.shape).diagonal();
  const double base = std::max(2 * max_edge_tolerance(model.shape), stated_resolution);
  TopoDS_Shape best;
  std::vector<TopoDS_Shape> best_images;
  double best_tolerance = 0;
  for (double relative : kSewRelative) {
    const double tolerance = std::max(relative * diagonal, relative == kSewRelative[0] ? std::min(base, 1e-4 * diagonal) : 0.0);
    BRepBuilderAPI_Sewing sewing(tolerance);
    sewing.Add(model.shape);
    try {
      sewing.Perform();
    } catch (const Standard_Failure&) {
      continue;
    }
    const TopoDS_Shape sewn = sewing.SewedShape();
    if (sewn.IsNull()) continue;
    const int n_free = count_free_edges(sewn);
    if (n_free >= best_free || !keeps_faces(sewing, sewn, model.faces)) continue;
    best_free = n_free;
    best = sewn;
    best_tolerance = tolerance;
    best_images.clear();
    for (int i = 1; i <= model.faces.Extent(); ++i) best_images.push_back(image_of(sewing, model.faces(i)));
    if (n_free == 0) break;
  }
  if (best.IsNull()) return;
  const TopTools_IndexedMapOfShape originals = model.faces;
  model.replace(ordered_solids(best, best_images), [&](const TopoDS_Shape& face) { return best_images[originals.FindIndex(face) - 1]; });
  findings.push_back({"sewn: " + std::to_string(free_before) + " free edges before, " + std::to_string(best_free) + " after",
                      "",
                      {},
                      best_tolerance,
                      true});
}

}  // namespace st::occt
