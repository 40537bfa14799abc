#include "geometry/import/shape_repair.h"

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepLib.hxx>
#include <BRepTools_ReShape.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box2d.hxx>
#include <Geom2d_Curve.hxx>
#include <Precision.hxx>
#include <ShapeBuild_ReShape.hxx>
#include <ShapeFix_Edge.hxx>
#include <ShapeFix_Shape.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Iterator.hxx>
#include <numeric>
#include <vector>

#include "base/threads.h"
#include "geometry/brep/occt_evaluators.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/brep/wire_walk.h"
#include "geometry/import/import.h"

namespace st::occt {
namespace {

/// Loops of a face that cannot be walked; 1 for a face without loops.
int count_bad_wires(const TopoDS_Shape& face) {
  const TopoDS_Face f = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  const Box2 bounds = uv_box(f);
  int n = 0, n_wires = 0;
  for (TopoDS_Iterator w(f); w.More(); w.Next()) {
    if (w.Value().ShapeType() != TopAbs_WIRE) continue;
    ++n_wires;
    n += !can_be_walked(TopoDS::Wire(w.Value()), f, bounds);
  }
  return n_wires == 0 ? 1 : n;
}

/// Of all faces, on all threads.
int count_all_bad_wires(const ImportedShape& model) {
  constexpr std::size_t kAtOnce = 8;
  std::vector<int> n_bad(static_cast<std::size_t>(model.faces.Extent()), 0);
  parallel_for(n_bad.size(), kAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) n_bad[i] = count_bad_wires(model.faces(static_cast<int>(i) + 1));
  });
  return std::accumulate(n_bad.begin(), n_bad.end(), 0);
}

/// Takes over the repair that OpenCASCADE makes of the whole.
void rebuild_bad_loops(ImportedShape& model, int n_bad, std::vector<ImportFinding>& findings) {
  ShapeFix_Shape fix(model.shape);
  fix.Perform();
  if (model.replace(fix.Shape(), [&](const TopoDS_Shape& face) { return fix.Context()->Apply(face); }))
    findings.push_back({FindingKind::kRebuiltLoops, "", {}, 0, true, std::to_string(n_bad)});
}

/// A surface closed in both directions whose loops enclose nothing: they run along a seam and back, the other seam is
/// missing.
bool is_ring_without_bounds(const TopoDS_Face& face) {
  constexpr double kNothing = 1e-6;  // of the surface's range
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  if (!surface->IsUClosed() || !surface->IsVClosed() || !TopoDS_Iterator(face).More()) return false;
  double u0, u1, v0, v1;
  surface->Bounds(u0, u1, v0, v1);
  Bnd_Box2d box;
  for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
    double t0, t1;
    const Handle(Geom2d_Curve) pcurve = BRep_Tool::CurveOnSurface(TopoDS::Edge(e.Current()), face, t0, t1);
    if (pcurve.IsNull()) return false;
    for (int k = 0; k <= 16; ++k) box.Add(pcurve->Value(t0 + (t1 - t0) * k / 16));
  }
  double u_low, v_low, u_high, v_high;
  box.Get(u_low, v_low, u_high, v_high);
  return u_high - u_low < kNothing * (u1 - u0) || v_high - v_low < kNothing * (v1 - v0);
}

/// Rings without bounds that no other face touches get their surface's own.
void bound_rings(ImportedShape& model, std::vector<ImportFinding>& findings) {
  TopTools_IndexedDataMapOfShapeListOfShape faces_of;
  TopExp::MapShapesAndAncestors(model.shape, TopAbs_EDGE, TopAbs_FACE, faces_of);
  const Handle(BRepTools_ReShape) reshape = new BRepTools_ReShape;
  int n = 0;
  for (int i = 1; i <= model.faces.Extent(); ++i) {
    const TopoDS_Face face = TopoDS::Face(model.faces(i).Oriented(TopAbs_FORWARD));
    if (!is_ring_without_bounds(face)) continue;
    bool is_alone = true;
    for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next())
      for (const TopoDS_Shape& other : faces_of.FindFromKey(e.Current())) is_alone &= bool(other.IsSame(face));
    const BRepBuilderAPI_MakeFace maker(BRep_Tool::Surface(face), Precision::Confusion());
    if (!is_alone || !maker.IsDone()) continue;
    reshape->Replace(face, maker.Face());
    const Box3 box = rough_box(maker.Face());
    findings.push_back({FindingKind::kUnboundedRing, "face " + std::to_string(i), box.center(), box.diagonal(), true});
    ++n;
  }
  if (n > 0) model.replace(reshape->Apply(model.shape), [&](const TopoDS_Shape& face) { return reshape->Apply(face); });
}

}  // namespace

void repair_loops(ImportedShape& model, std::vector<ImportFinding>& findings) {
  bound_rings(model, findings);
  const int n_bad = count_all_bad_wires(model);
  if (n_bad > 0) rebuild_bad_loops(model, n_bad, findings);
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(model.shape, TopAbs_EDGE, edges);
  int n_parameters = 0;
  for (int i = 1; i <= edges.Extent(); ++i) {
    const TopoDS_Edge e = TopoDS::Edge(edges(i));
    if (BRep_Tool::Degenerated(e) || (BRep_Tool::SameParameter(e) && BRep_Tool::SameRange(e))) continue;
    BRepLib::SameParameter(e, BRep_Tool::Tolerance(e));
    ++n_parameters;
  }
  if (n_parameters) findings.push_back({FindingKind::kEdgeParameters, "", {}, 0, true, std::to_string(n_parameters)});
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
        n_pcurves += !BRep_Tool::CurveOnSurface(edge, f, t0, t1).IsNull();
      }
    }
  }
  if (n_pcurves) findings.push_back({FindingKind::kMissingTrimmingCurves, "", {}, 0, true, std::to_string(n_pcurves)});
}

}  // namespace st::occt
