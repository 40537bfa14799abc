#include "geometry/shape_repair.h"

#include <BRepLib.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Tool.hxx>
#include <ShapeBuild_ReShape.hxx>
#include <ShapeFix_Edge.hxx>
#include <ShapeFix_Face.hxx>
#include <ShapeFix_Shape.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Iterator.hxx>

#include "geometry/occt_evaluators.h"

namespace st::occt {
namespace {

int count_bad_wires(const TopTools_IndexedMapOfShape& faces) {
  int n = 0;
  for (int i = 1; i <= faces.Extent(); ++i) {
    const TopoDS_Face f = TopoDS::Face(faces(i).Oriented(TopAbs_FORWARD));
    int n_wires = 0;
    for (TopoDS_Iterator w(f); w.More(); w.Next()) {
      if (w.Value().ShapeType() != TopAbs_WIRE) continue;
      ++n_wires;
      int n_edges = 0, n_walked = 0;
      for (TopExp_Explorer e(w.Value(), TopAbs_EDGE); e.More(); e.Next()) n_edges += !is_constraint(e.Current());
      for (BRepTools_WireExplorer e(TopoDS::Wire(w.Value()), f); e.More(); e.Next()) ++n_walked;
      n += n_edges != n_walked;
    }
    n += n_wires == 0;
  }
  return n;
}

}  // namespace

void repair_loops(ImportedShape& model, std::vector<ImportFinding>& findings) {
  const int n_bad = count_bad_wires(model.faces);
  if (n_bad > 0) {
    ShapeFix_Shape fix(model.shape);
    fix.Perform();
    if (model.replace(fix.Shape(), [&](const TopoDS_Shape& s) { return fix.Context()->Apply(s); }))
      findings.push_back({"loops: " + std::to_string(n_bad) + " loops or faces that could not be walked were rebuilt", "", {}, 0, true});
  }
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(model.shape, TopAbs_EDGE, edges);
  int n_parameters = 0;
  for (int i = 1; i <= edges.Extent(); ++i) {
    const TopoDS_Edge e = TopoDS::Edge(edges(i));
    if (BRep_Tool::Degenerated(e) || (BRep_Tool::SameParameter(e) && BRep_Tool::SameRange(e))) continue;
    BRepLib::SameParameter(e, BRep_Tool::Tolerance(e));
    ++n_parameters;
  }
  if (n_parameters)
    findings.push_back({"parameters of " + std::to_string(n_parameters) + " edges made equal to their trimming curves'", "", {}, 0, true});
  int n_pcurves = 0;
  for (int i = 1; i <= model.faces.Extent(); ++i) {
    const TopoDS_Face f = TopoDS::Face(model.faces(i).Oriented(TopAbs_FORWARD));
    const bool planar = occt::surface_type(BRep_Tool::Surface(f)) == SurfaceType::kPlane;
    for (TopExp_Explorer e(f, TopAbs_EDGE); e.More(); e.Next()) {
      const TopoDS_Edge edge = TopoDS::Edge(e.Current());
      double t0, t1;
      Standard_Boolean stored = true;
      if (planar) {
        BRep_Tool::CurveOnSurface(edge, f, t0, t1, &stored);
        if (!stored) BRepLib::BuildPCurveForEdgeOnPlane(edge, f);
      } else if (BRep_Tool::CurveOnSurface(edge, f, t0, t1, &stored).IsNull()) {
        ShapeFix_Edge().FixAddPCurve(edge, f, BRep_Tool::IsClosed(edge, f));
        ++n_pcurves;
      }
    }
  }
  if (n_pcurves)
    findings.push_back({"trimming curves of " + std::to_string(n_pcurves) + " edges were missing and rebuilt", "", {}, 0, true});
}

}  // namespace st::occt
