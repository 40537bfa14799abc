#include "geometry/import/kinked_faces.h"

#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <GCPnts_AbscissaPoint.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <Geom_Surface.hxx>
#include <Precision.hxx>
#include <ShapeBuild_ReShape.hxx>
#include <ShapeExtend_CompositeSurface.hxx>
#include <ShapeFix_ComposeShell.hxx>
#include <ShapeUpgrade_SplitSurface.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_HSequenceOfReal.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "geometry/brep/face_domain.h"
#include "geometry/brep/face_integral.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/import/pcurve_repair.h"
#include "geometry/import/placed_copy.h"
#include "geometry/import/surface_kinks.h"
#include "geometry/model/sameness.h"

namespace st::occt {
namespace {

constexpr double kBeyond = 0.01;      // of a face's range in (u,v): its trimming curves stay inside the new surfaces
constexpr double kSameLength = 1e-3;  // of a face's diagonal: free edges before and after

using Kinks = std::map<int, SurfaceKinks>;  // by the number of the face

Kinks kinks_of(const ImportedShape& model) {
  Kinks found;
  for (int i = 1; i <= model.faces.Extent(); ++i) try {
      if (auto kinks = find_kinks(TopoDS::Face(model.faces(i).Oriented(TopAbs_FORWARD)))) found[i] = std::move(*kinks);
    } catch (const Standard_Failure&) {  // cannot be evaluated: later stages judge
    }
  return found;
}

Handle(TColStd_HSequenceOfReal) sequence_of(const std::vector<double>& values) {
  Handle(TColStd_HSequenceOfReal) sequence = new TColStd_HSequenceOfReal;
  for (const double t : values) sequence->Append(t);
  return sequence;
}

/// The surfaces between the kinks.
Handle(ShapeExtend_CompositeSurface) parts_of_surface(const TopoDS_Face& face, const SurfaceKinks& kinks) {
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  double u0, u1, v0, v1, least_u, most_u, least_v, most_v;
  BRepTools::UVBounds(face, u0, u1, v0, v1);
  surface->Bounds(least_u, most_u, least_v, most_v);
  const double room_u = surface->IsUPeriodic() ? 0 : kBeyond * (u1 - u0);
  const double room_v = surface->IsVPeriodic() ? 0 : kBeyond * (v1 - v0);
  if (!surface->IsUPeriodic()) u0 = std::max(u0 - room_u, least_u), u1 = std::min(u1 + room_u, most_u);
  if (!surface->IsVPeriodic()) v0 = std::max(v0 - room_v, least_v), v1 = std::min(v1 + room_v, most_v);
  ShapeUpgrade_SplitSurface split;
  split.Init(surface, u0, u1, v0, v1);
  split.SetUSplitValues(sequence_of(kinks.u));
  split.SetVSplitValues(sequence_of(kinks.v));
  split.Build(true);
  return split.ResSurfaces();
}

/// How long the edges of `faces` are that no other face of the model has.
double free_length(const std::vector<TopoDS_Shape>& faces, const TopTools_IndexedMapOfShape& edges,
                   const std::vector<int>& uses) {
  double sum = 0;
  for (const TopoDS_Shape& face : faces)
    for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
      const TopoDS_Edge edge = TopoDS::Edge(e.Current());
      const int i = edges.FindIndex(edge);
      double t0, t1;
      const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, t0, t1);
      if (i > 0 && uses[i - 1] == 1 && !curve.IsNull())
        sum += GCPnts_AbscissaPoint::Length(GeomAdaptor_Curve(curve), t0, t1);
    }
  return sum;
}

double area_of(const std::vector<TopoDS_Shape>& faces) {
  double area = 0;
  for (const TopoDS_Shape& face : faces)
    area += std::abs(integrate_face(make_domain(TopoDS::Face(face.Oriented(TopAbs_FORWARD))), {}).area);
  return area;
}

/// The model with some of its faces divided, and what became of it.
class DividedModel {
 public:
  explicit DividedModel(const ImportedShape& model) : model_(model), shape_(copy_.of(model.shape)) {}

  void divide(int i, const SurfaceKinks& kinks) try {
    const TopoDS_Shape face = reshape_->Apply(copy_.of(model_.faces(i)).Oriented(TopAbs_FORWARD));
    if (face.IsNull() || face.ShapeType() != TopAbs_FACE) return;
    ShapeFix_ComposeShell parts;
    parts.Init(parts_of_surface(TopoDS::Face(face), kinks), {}, TopoDS::Face(face), Precision::Confusion());
    parts.SetContext(reshape_);
    parts.SetMaxTolerance(kSameArea * rough_box(face).diagonal());
    if (parts.Perform() && !parts.Result().IsNull()) reshape_->Replace(face, parts.Result());
  } catch (const Standard_Failure&) {  // in one part: refused
  }

  void finish() {
    result_ = reshape_->Apply(shape_);
    uses_ = edge_uses(result_, edges_);
    uses_before_ = edge_uses(model_.shape, edges_before_);
  }

  std::vector<TopoDS_Shape> parts(int i) {
    std::vector<TopoDS_Shape> faces;
    for (TopExp_Explorer f(image(model_.faces(i)), TopAbs_FACE); f.More(); f.Next()) faces.push_back(f.Current());
    return faces;
  }

  bool is_sound(int i) try {
    const std::vector<TopoDS_Shape> before{model_.faces(i)}, after = parts(i);
    if (after.size() < 2) return false;
    const double area = area_of(before), size = rough_box(before[0]).diagonal();
    return std::abs(area_of(after) - area) <= kSameArea * area &&
           std::abs(free_length(after, edges_, uses_) - free_length(before, edges_before_, uses_before_)) <=
               kSameLength * size;
  } catch (const Standard_Failure&) {
    return false;
  }

  void take_over(ImportedShape& model) {
    std::vector<std::pair<TopoDS_Shape, std::string>> names;
    for (const auto& [edge, name] : model_.edge_names)
      if (copy_.has(edge))
        for (TopExp_Explorer e(image(edge), TopAbs_EDGE); e.More(); e.Next()) names.emplace_back(e.Current(), name);
    ImportedShape divided = model_;
    divided.replace(result_, [this](const TopoDS_Shape& face) { return image(face); });
    divided.edge_names = std::move(names);
    model = std::move(divided);
  }

 private:
  TopoDS_Shape image(const TopoDS_Shape& shape) { return reshape_->Apply(copy_.of(shape)); }

  const ImportedShape& model_;
  PlacedCopy copy_;
  TopoDS_Shape shape_, result_;
  Handle(ShapeBuild_ReShape) reshape_ = new ShapeBuild_ReShape;
  TopTools_IndexedMapOfShape edges_, edges_before_;
  std::vector<int> uses_, uses_before_;
};

}  // namespace

void divide_kinked_faces(ImportedShape& model, std::vector<ImportFinding>& findings) {
  Kinks kinks = kinks_of(model);
  const auto say = [&](FindingKind kind, int i, const std::string& detail) {
    const Box3 box = rough_box(model.faces(i));
    findings.push_back(
        {kind, model.file_label(i), kinks[i].xyz, box.diagonal(), kind == FindingKind::kDividedSurface, detail});
  };
  std::set<int> left;
  for (const auto& [i, k] : kinks) left.insert(i);
  while (!left.empty()) {
    DividedModel divided(model);
    for (const int i : left) divided.divide(i, kinks[i]);
    divided.finish();
    std::set<int> sound;
    for (const int i : left)
      if (divided.is_sound(i)) sound.insert(i);
    if (sound.size() == left.size()) {
      for (const int i : left) say(FindingKind::kDividedSurface, i, std::to_string(divided.parts(i).size()) + " faces");
      divided.take_over(model);
      std::vector<ImportFinding> of_parts;
      repair_pcurves(model, of_parts);
      return;
    }
    for (const int i : left)
      if (sound.count(i) == 0) say(FindingKind::kKinkedFace, i, "");
    left = sound;
  }
}

}  // namespace st::occt
