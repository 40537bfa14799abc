#include "geometry/import/nested_solids.h"

#include <BRepClass3d_SolidClassifier.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>

#include "base/boxes.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/import/plane_loops.h"

namespace st::occt {
namespace {

/// The outermost shell of a solid, as a solid of its own: without cavities.
TopoDS_Solid filled(const TopoDS_Shape& solid) {
  TopoDS_Solid result;
  BRep_Builder builder;
  builder.MakeSolid(result);
  for (TopExp_Explorer s(solid, TopAbs_SHELL); s.More(); s.Next())
    if (volume_of(s.Current()) > 0) builder.Add(result, s.Current());
  return result;
}

/// Whether all vertices are inside, or on the boundary but not all of them.
bool is_inside(const TopoDS_Shape& body, const TopoDS_Solid& outer) {
  constexpr double kOnBoundary = 1e-7;
  TopTools_IndexedMapOfShape vertices;
  TopExp::MapShapes(body, TopAbs_VERTEX, vertices);
  BRepClass3d_SolidClassifier classifier(outer);
  bool is_any = false;
  for (int i = 1; i <= vertices.Extent(); ++i) {
    classifier.Perform(BRep_Tool::Pnt(TopoDS::Vertex(vertices(i))), kOnBoundary);
    if (classifier.State() == TopAbs_OUT) return false;
    is_any = is_any || classifier.State() == TopAbs_IN;
  }
  return is_any;
}

}  // namespace

std::vector<NestedSolid> nested_solids(const TopoDS_Shape& shape, Cavities cavities,
                                       const std::function<bool(const Box3&)>& is_asked) {
  std::vector<TopoDS_Solid> solids;
  std::vector<Box3> boxes;
  for (TopExp_Explorer e(shape, TopAbs_SOLID); e.More(); e.Next()) {
    solids.push_back(TopoDS::Solid(e.Current()));
    boxes.push_back(rough_box(e.Current()));
  }
  std::vector<NestedSolid> nested;
  for (std::size_t i = 0; i < solids.size(); ++i)
    for (std::size_t k = 0; k < solids.size(); ++k) {
      if (i == k || (is_asked && !is_asked(boxes[i])) || !contains(boxes[k], boxes[i])) continue;
      if (!is_inside(solids[i], cavities == Cavities::kInside ? filled(solids[k]) : solids[k])) continue;
      nested.push_back({solids[i], solids[k]});
      break;
    }
  return nested;
}

}  // namespace st::occt
