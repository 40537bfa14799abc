#include "geometry/import/shell_repair.h"
#include "base/boxes.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/import/false_joins.h"
#include "geometry/import/import.h"

#include <BRepClass3d_SolidClassifier.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <cmath>
#include <limits>

namespace st::occt {
namespace {

double signed_volume(const ImportedShape& model, const FaceMeasures& measures, const TopoDS_Shape& shape) {
  double volume = 0;
  for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next())
    volume += (e.Current().Orientation() == TopAbs_REVERSED ? -1 : 1) *
              measures.cone_volume[model.faces.FindIndex(e.Current()) - 1];
  return volume;
}

/// A loose closed shell, turned outward.
struct LooseShell {
  TopoDS_Shape original, outward;
  Box3 box;
  double volume = 0;
  int depth = 0;       ///< number of others around it
  int container = -1;  ///< smallest of these
};

std::vector<LooseShell> loose_closed_shells(const ImportedShape& model, const FaceMeasures& measures) {
  std::vector<LooseShell> shells;
  for (TopExp_Explorer e(model.shape, TopAbs_SHELL, TopAbs_SOLID); e.More(); e.Next()) {
    if (count_free_edges(e.Current()) > 0) continue;
    const double volume = signed_volume(model, measures, e.Current());
    if (volume == 0 || !find_false_joins(e.Current(), std::numeric_limits<double>::infinity()).empty()) continue;
    shells.push_back(
        {e.Current(), volume < 0 ? e.Current().Reversed() : e.Current(), rough_box(e.Current()), std::fabs(volume)});
  }
  return shells;
}

TopoDS_Solid solid_of(const TopoDS_Shape& shell) {
  TopoDS_Solid solid;
  BRep_Builder builder;
  builder.MakeSolid(solid);
  builder.Add(solid, shell);
  return solid;
}

bool contains(const LooseShell& outer, const LooseShell& inner) {
  if (outer.volume <= inner.volume || !contains(outer.box, inner.box)) return false;
  const TopExp_Explorer vertex(inner.original, TopAbs_VERTEX);
  if (!vertex.More()) return false;
  BRepClass3d_SolidClassifier classifier(solid_of(outer.outward), BRep_Tool::Pnt(TopoDS::Vertex(vertex.Current())),
                                         1e-7);
  return classifier.State() == TopAbs_IN;
}

void find_containers(std::vector<LooseShell>& shells) {
  for (std::size_t i = 0; i < shells.size(); ++i)
    for (std::size_t k = 0; k < shells.size(); ++k) {
      if (i == k || !contains(shells[k], shells[i])) continue;
      ++shells[i].depth;
      if (shells[i].container < 0 || shells[k].volume < shells[shells[i].container].volume)
        shells[i].container = static_cast<int>(k);
    }
}

/// The shape with shells and solids exchanged: null leaves one out.
template <class Exchange>
TopoDS_Shape exchanged(const TopoDS_Shape& shape, const Exchange& exchange) {
  if (shape.ShapeType() != TopAbs_COMPOUND) return exchange(shape);
  TopoDS_Compound result;
  BRep_Builder builder;
  builder.MakeCompound(result);
  for (TopoDS_Iterator child(shape); child.More(); child.Next())
    if (const TopoDS_Shape s = exchanged(child.Value(), exchange); !s.IsNull()) builder.Add(result, s);
  return result;
}

ImportFinding repair(FindingKind kind, const TopoDS_Shape& shape) {
  const Box3 box = rough_box(shape);
  return {kind, "", box.center(), box.diagonal(), true};
}

/// A lone face that closes on itself, as a sphere from IGES, becomes a shell of its own.
bool shell_lone_faces(ImportedShape& model) {
  bool is_changed = false;
  const auto exchange = [&](const TopoDS_Shape& shape) -> TopoDS_Shape {
    if (shape.ShapeType() != TopAbs_FACE || count_free_edges(shape) > 0) return shape;
    TopoDS_Shell shell;
    BRep_Builder builder;
    builder.MakeShell(shell);
    builder.Add(shell, shape);
    is_changed = true;
    return shell;
  };
  const TopoDS_Shape shelled = exchanged(model.shape, exchange);
  return is_changed && model.replace(shelled, [](const TopoDS_Shape& face) { return face; });
}

}  // namespace

bool repair_shells(ImportedShape& model, const FaceMeasures& measures, std::vector<ImportFinding>& findings) {
  const bool is_shelled = shell_lone_faces(model);
  std::vector<LooseShell> shells = loose_closed_shells(model, measures);
  find_containers(shells);
  bool is_changed = false;
  const auto exchange = [&](const TopoDS_Shape& shape) -> TopoDS_Shape {
    if (shape.ShapeType() == TopAbs_SOLID && signed_volume(model, measures, shape) < 0 &&
        count_free_edges(shape) == 0) {
      findings.push_back(repair(FindingKind::kTurnedSolid, shape));
      is_changed = true;
      return shape.Reversed();
    }
    for (std::size_t i = 0; i < shells.size(); ++i) {
      if (shape.ShapeType() != TopAbs_SHELL || !shape.IsSame(shells[i].original)) continue;
      is_changed = true;
      if (shells[i].depth % 2 == 1) {
        findings.push_back(repair(FindingKind::kVoidShell, shape));
        return {};
      }
      TopoDS_Solid solid = solid_of(shells[i].outward);
      for (const LooseShell& inner : shells)
        if (inner.depth % 2 == 1 && inner.container == static_cast<int>(i))
          BRep_Builder().Add(solid, inner.outward.Reversed());
      findings.push_back(repair(FindingKind::kShellMadeSolid, shape));
      return solid;
    }
    return shape;
  };
  const TopoDS_Shape repaired = exchanged(model.shape, exchange);
  return (is_changed && model.replace(repaired, [](const TopoDS_Shape& face) { return face; })) || is_shelled;
}

}  // namespace st::occt
