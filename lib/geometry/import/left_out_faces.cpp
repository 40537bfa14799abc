#include "geometry/import/left_out_faces.h"

#include <BRepTools_ReShape.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Curve.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/finite.h"

namespace st::occt {
namespace {

/// Empty: it can be meshed.
std::string why_not(const TopoDS_Face& face, const ModelTables& t, FaceId f) {
  if (!std::isfinite(t.face_area[f])) return "its surface cannot be evaluated, its area is no number";
  if (!is_finite(t.face_box[f])) return "its surface cannot be evaluated, its extent is no number";
  for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(e.Current());
    if (is_constraint(edge)) continue;
    TopLoc_Location where;
    double t0, t1;
    const bool has_pcurve = !BRep_Tool::CurveOnSurface(edge, face, t0, t1).IsNull();
    if (!has_pcurve) return "an edge of it has no trimming curve, and none can be made";
    if (!BRep_Tool::Degenerated(edge) && BRep_Tool::Curve(edge, where, t0, t1).IsNull())
      return "an edge of it has no curve in space, and none can be made";
  }
  return {};
}

}  // namespace

bool leave_out_faces(ImportedShape& model, const ModelTables& t, std::vector<ImportFinding>& findings,
                     const std::string& path) {
  const Handle(BRepTools_ReShape) reshape = new BRepTools_ReShape;
  std::vector<ImportFinding> left_out;
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    const TopoDS_Face face = TopoDS::Face(model.faces(f + 1).Oriented(TopAbs_FORWARD));
    const std::string why = why_not(face, t, f);
    if (why.empty()) continue;
    reshape->Remove(face);
    const Box3 box = t.face_box[f];
    const bool has_box = is_finite(box);
    left_out.push_back({FindingKind::kLeftOutFace, t.face_label(f), has_box ? box.center() : Vec3{},
                        has_box ? box.diagonal() : 0, false, why});
  }
  if (left_out.empty()) return false;
  const auto image = [&](const TopoDS_Shape& face) { return reshape->Apply(face); };
  if (left_out.size() == static_cast<std::size_t>(t.n_faces()) || !model.replace(reshape->Apply(model.shape), image))
    throw Error(ExitCode::kGeometry, path + ": " + left_out[0].entity + " cannot be meshed: " + left_out[0].detail +
                                         "; no other face is left, so repair it in the CAD system");
  findings.insert(findings.end(), left_out.begin(), left_out.end());
  return true;
}

}  // namespace st::occt
