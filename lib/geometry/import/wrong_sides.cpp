#include "geometry/import/wrong_sides.h"

#include <BRepTools_ReShape.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Surface.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <cmath>
#include <vector>

#include "geometry/brep/shape_queries.h"
#include "geometry/import/other_side.h"
#include "geometry/import/seam_loop.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {
namespace {

/// Out of the face, at the middle of an edge; null where it has none.
gp_Vec normal_at(const TopoDS_Edge& edge, const TopoDS_Face& face) {
  double t0, t1;
  const Handle(Geom2d_Curve) pcurve = BRep_Tool::CurveOnSurface(edge, face, t0, t1);
  if (pcurve.IsNull()) return {};
  const gp_Pnt2d uv = pcurve->Value(0.5 * (t0 + t1));
  gp_Pnt p;
  gp_Vec du, dv;
  BRep_Tool::Surface(face)->D1(uv.X(), uv.Y(), p, du, dv);
  const gp_Vec normal = du.Crossed(dv);
  return face.Orientation() == TopAbs_REVERSED ? normal.Reversed() : normal;
}

/// How a face goes on into the others of its shell, at most of its edges: its other side would be folded back where it
/// goes on smoothly.
enum class GoesOn { kSmoothly, kFolded, kNeither };

/// By the faces that can be on one side only, if there are any at its edges.
GoesOn how_it_goes_on(const TopoDS_Face& face, const TopTools_IndexedDataMapOfShapeListOfShape& faces_of) {
  constexpr double kSmooth = 0.5;   // radians: far below the angle of a stem and far above that of a fillet
  constexpr double kFolded = 1e-3;  // radians: tangent; thin lenses and sharp rims of dimples are wedges of more
  int n_edges = 0, n_smooth = 0, n_folded = 0;
  for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(e.Current());
    const int k = faces_of.FindIndex(edge);
    if (k == 0 || BRep_Tool::Degenerated(edge)) continue;
    ++n_edges;
    for (const TopoDS_Shape& other : faces_of(k)) {
      if (other.IsSame(face)) continue;
      const gp_Vec a = normal_at(edge, face), b = normal_at(edge, TopoDS::Face(other));
      if (a.Magnitude() == 0 || b.Magnitude() == 0) continue;
      n_smooth += a.Angle(b) < kSmooth;
      n_folded += a.Angle(b) > M_PI - kFolded && !may_be_on_either_side(TopoDS::Face(other));
    }
  }
  if (2 * n_smooth > n_edges) return GoesOn::kSmoothly;
  return 2 * n_folded > n_edges ? GoesOn::kFolded : GoesOn::kNeither;
}

/// What is known of the faces of a part, by their place among its faces.
struct PartFaces {
  const CadPart& part;
  TopTools_IndexedMapOfShape index;

  explicit PartFaces(const CadPart& p) : part(p) {
    for (const CadPart::FaceAttributes& f : p.faces) index.Add(f.face);
  }
  const CadPart::FaceAttributes* find(const TopoDS_Shape& face) const {
    const int k = index.FindIndex(face);
    return k > 0 ? &part.faces[k - 1] : nullptr;
  }
};

/// Faces of a shell that may be on either side of their loop, and are on the wrong one: those that had a seam in the
/// file, those that are folded back onto others, and those that lie on another side than the file says.
std::vector<TopoDS_Face> wrong_sides_of(const TopoDS_Shape& shell, const PartFaces& faces) {
  std::vector<TopoDS_Face> wrong;
  TopTools_IndexedDataMapOfShapeListOfShape faces_of;
  for (TopExp_Explorer f(shell, TopAbs_FACE); f.More(); f.Next()) {
    const TopoDS_Face face = TopoDS::Face(f.Current());
    const CadPart::FaceAttributes* in_file = faces.find(face);
    if (!in_file || !in_file->lies_as_said || !may_be_on_either_side(face)) continue;
    if (faces_of.IsEmpty()) TopExp::MapShapesAndAncestors(shell, TopAbs_EDGE, TopAbs_FACE, faces_of);
    const GoesOn goes_on = how_it_goes_on(face, faces_of);
    const bool is_elsewhere = !*in_file->lies_as_said && goes_on == GoesOn::kNeither;  // files may err at fillets
    if (in_file->has_seam || goes_on == GoesOn::kFolded || is_elsewhere) wrong.push_back(face);
  }
  return wrong;
}

/// A cavity that was outside its solid, of which a face was on its wrong side, is a solid of its own: what is closed
/// becomes solids anew.
TopoDS_Shape as_loose_shells(const TopoDS_Shape& shape) {
  TopoDS_Compound shells;
  BRep_Builder builder;
  builder.MakeCompound(shells);
  for (TopExp_Explorer s(shape, TopAbs_SHELL); s.More(); s.Next()) builder.Add(shells, s.Current());
  for (TopExp_Explorer f(shape, TopAbs_FACE, TopAbs_SHELL); f.More(); f.Next()) builder.Add(shells, f.Current());
  return shells;
}

}  // namespace

void mend_wrong_sides(CadFile& file, std::vector<ImportFinding>& findings) {
  std::int32_t first = 0;  // number of the part's first face in the file, from 0
  for (CadPart& part : file.parts) {
    const PartFaces faces(part);
    const Handle(BRepTools_ReShape) reshape = new BRepTools_ReShape;
    bool is_changed = false;
    const auto replace = [&](const TopoDS_Face& face, const TopoDS_Face& mended) {
      if (mended.IsNull() || reshape->IsRecorded(face)) return;
      reshape->Replace(face, mended);
      is_changed = true;
      const Box3 box = rough_box(mended);
      findings.push_back({FindingKind::kOtherSide, file_label(first + faces.index.FindIndex(face) - 1), box.center(),
                          box.diagonal(), true});
    };
    const bool is_any_seam_unknown = file.format == "IGES";  // its faces share no edges, not even with themselves
    for (const CadPart::FaceAttributes& f : part.faces)
      if (f.has_seam || is_any_seam_unknown) replace(TopoDS::Face(f.face), with_chains_turned(TopoDS::Face(f.face)));
    for (TopExp_Explorer s(part.shape, TopAbs_SHELL); s.More(); s.Next())
      for (const TopoDS_Face& face : wrong_sides_of(s.Current(), faces)) replace(face, other_side(face));
    first += static_cast<std::int32_t>(part.faces.size());
    if (!is_changed) continue;
    for (CadPart::FaceAttributes& f : part.faces) f.face = reshape->Apply(f.face);
    part.shape = reshape->Apply(part.shape);
    if (file.has_voids) part.shape = as_loose_shells(part.shape);
  }
}

}  // namespace st::occt
