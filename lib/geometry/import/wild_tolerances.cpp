#include "geometry/import/wild_tolerances.h"

#include <BRep_Tool.hxx>
#include <Geom_Curve.hxx>
#include <ShapeFix_ShapeTolerance.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>

namespace st::occt {
namespace {

double vertex_gap(const TopoDS_Edge& edge, const TopoDS_Vertex& vertex) {
  double t0 = 0, t1 = 0;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, t0, t1);
  if (curve.IsNull()) return 0;
  const gp_Pnt p = BRep_Tool::Pnt(vertex);
  return std::min(p.Distance(curve->Value(t0)), p.Distance(curve->Value(t1)));
}

}  // namespace

void tighten_tolerances(const TopoDS_Shape& shape, double sewing_tolerance, double limit) {
  const ShapeFix_ShapeTolerance setter;
  TopTools_IndexedDataMapOfShapeListOfShape vertex_edges;
  TopExp::MapShapesAndAncestors(shape, TopAbs_VERTEX, TopAbs_EDGE, vertex_edges);
  for (TopExp_Explorer e(shape, TopAbs_EDGE); e.More(); e.Next())
    if (BRep_Tool::Tolerance(TopoDS::Edge(e.Current())) > limit)
      setter.SetTolerance(e.Current(), sewing_tolerance, TopAbs_EDGE);
  for (int i = 1; i <= vertex_edges.Extent(); ++i) {
    const TopoDS_Vertex vertex = TopoDS::Vertex(vertex_edges.FindKey(i));
    if (BRep_Tool::Tolerance(vertex) <= limit) continue;
    double needed = sewing_tolerance;
    for (const TopoDS_Shape& edge : vertex_edges(i))
      needed =
          std::max({needed, BRep_Tool::Tolerance(TopoDS::Edge(edge)), 1.01 * vertex_gap(TopoDS::Edge(edge), vertex)});
    setter.SetTolerance(vertex, needed, TopAbs_VERTEX);
  }
}

}  // namespace st::occt
