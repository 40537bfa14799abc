#include "geometry/import/kept_areas.h"

#include <BRepTools_ReShape.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Surface.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "geometry/brep/compound.h"
#include "geometry/brep/face_domain.h"
#include "geometry/brep/face_integral.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/model/sameness.h"

namespace st::occt {
namespace {

constexpr int kSteps = 4;           // along each trimming curve: the same before and after
constexpr double kSameInUv = 1e-3;  // of what the loops enclose
constexpr double kRoom = 3;         // times what edges sweep: bends, and both sides of an edge

/// What the loops of a face enclose in (u,v), by a few points of each curve; edges in any order.
double enclosed(const TopoDS_Face& shape) {
  const TopoDS_Face face = TopoDS::Face(shape.Oriented(TopAbs_FORWARD));
  double sum = 0;
  for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
    if (is_constraint(e.Current())) continue;
    double t0, t1;
    const Handle(Geom2d_Curve) c = BRep_Tool::CurveOnSurface(TopoDS::Edge(e.Current()), face, t0, t1);
    if (c.IsNull()) continue;
    const double sign = e.Current().Orientation() == TopAbs_REVERSED ? -0.5 : 0.5;
    gp_Pnt2d a = c->Value(t0);
    for (int k = 1; k <= kSteps; ++k) {
      const gp_Pnt2d b = c->Value(t0 + (t1 - t0) * k / kSteps);
      sum += sign * (a.X() + b.X()) * (b.Y() - a.Y());
      a = b;
    }
  }
  return sum;
}

/// Faces by their surface, which sewing leaves alone: places in the vector of all surfaces.
class BySurface {
 public:
  explicit BySurface(const TopTools_IndexedMapOfShape& faces) {
    for (int i = 1; i <= faces.Extent(); ++i) {
      TopLoc_Location where;
      const Handle(Geom_Surface) surface = BRep_Tool::Surface(TopoDS::Face(faces(i)), where);
      const auto [at, is_new] = number_.emplace(surface.get(), members_.size());  // for look-up alone: no order by it
      if (is_new) members_.emplace_back();
      members_[at->second].push_back(TopoDS::Face(faces(i)));
    }
  }

  /// In the order of the first face.
  std::vector<std::vector<TopoDS_Face>> sets() const { return members_; }
  std::vector<TopoDS_Face> on_surface_of(const TopoDS_Face& face) const {
    TopLoc_Location where;
    const auto at = number_.find(BRep_Tool::Surface(face, where).get());
    return at == number_.end() ? std::vector<TopoDS_Face>() : members_[at->second];
  }

 private:
  std::map<const Geom_Surface*, std::size_t> number_;
  std::vector<std::vector<TopoDS_Face>> members_;
};

double enclosed(const std::vector<TopoDS_Face>& faces) {
  double sum = 0;
  for (const TopoDS_Face& face : faces) sum += enclosed(face);
  return sum;
}

struct Extent {
  double area = 0, perimeter = 0, tolerance = 0;
};

Extent extent_of(const std::vector<TopoDS_Face>& faces) {
  Extent extent;
  for (const TopoDS_Face& face : faces) {
    const FaceDomain domain = make_domain(TopoDS::Face(face.Oriented(TopAbs_FORWARD)));
    if (!domain.loops.empty()) extent.area += std::abs(integrate_face(domain, {}).area);
    for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
      const TopoDS_Edge edge = TopoDS::Edge(e.Current());
      double t0, t1;
      extent.tolerance = std::max(extent.tolerance, BRep_Tool::Tolerance(edge));
      const Handle(Geom_Curve) c = BRep_Tool::Curve(edge, t0, t1);
      for (int k = 0; k < 4 * kSteps && !c.IsNull(); ++k)
        extent.perimeter +=
            c->Value(t0 + (t1 - t0) * k / (4 * kSteps)).Distance(c->Value(t0 + (t1 - t0) * (k + 1) / (4 * kSteps)));
    }
  }
  return extent;
}

/// The faces of `before` whose area `after` is not what sewing explains.
TopTools_IndexedMapOfShape changed_faces(const ImportedShape& before, const ImportedShape& after,
                                         std::vector<ImportFinding>& findings) {
  TopTools_IndexedMapOfShape changed;
  const BySurface sewn(after.faces);
  for (const std::vector<TopoDS_Face>& faces : BySurface(before.faces).sets()) try {
      const std::vector<TopoDS_Face> now = sewn.on_surface_of(faces[0]);
      if (now.empty()) continue;  // divided into parts of the surface
      const double was = enclosed(faces);
      if (std::abs(enclosed(now) - was) <= kSameInUv * std::abs(was)) continue;
      const Extent a = extent_of(faces), b = extent_of(now);
      if (std::abs(a.area - b.area) <= kRoom * b.tolerance * a.perimeter + kAboutSameArea * a.area) continue;
      const Box3 box = rough_box(faces[0]);
      findings.push_back(
          {FindingKind::kUndoneRepair, "face " + std::to_string(before.faces.FindIndex(faces[0])), box.center(),
           box.diagonal(), false,
           "sewn, it would have an area of " + format_number(b.area) + " instead of " + format_number(a.area)});
      for (const TopoDS_Face& face : faces) changed.Add(face);
    } catch (const Standard_Failure&) {  // cannot be measured: later stages judge
    }
  return changed;
}

/// Without the faces that are left out; no faces: there are no others.
ImportedShape others_of(const ImportedShape& model, const TopTools_IndexedMapOfShape& left_out) {
  ImportedShape others = model;
  const Handle(BRepTools_ReShape) reshape = new BRepTools_ReShape;
  for (int i = 1; i <= left_out.Extent(); ++i) reshape->Remove(left_out(i).Oriented(TopAbs_FORWARD));
  const auto image = [&](const TopoDS_Shape& face) { return reshape->Apply(face); };
  if (left_out.Extent() == model.faces.Extent() || !others.replace(reshape->Apply(model.shape), image))
    others.faces.Clear();
  return others;
}

/// `sewn` and, after it, the faces of `before` that were left out.
ImportedShape united(const ImportedShape& sewn, const ImportedShape& before,
                     const TopTools_IndexedMapOfShape& left_out) {
  ImportedShape all = sewn;
  std::vector<TopoDS_Shape> parts{sewn.shape};
  for (int i = 1; i <= left_out.Extent(); ++i) parts.push_back(left_out(i));
  all.shape = compound_of(parts);
  all.faces.Clear();
  TopExp::MapShapes(all.shape, TopAbs_FACE, all.faces);
  all.attributes.clear();
  for (int i = 1; i <= all.faces.Extent(); ++i) {
    const int k = sewn.faces.FindIndex(all.faces(i));
    all.attributes.push_back(k > 0 ? sewn.attributes[k - 1]
                                   : before.attributes[before.faces.FindIndex(all.faces(i)) - 1]);
  }
  return all;
}

}  // namespace

void sew_and_keep_areas(ImportedShape& model, const SewingLimits& limits, std::vector<ImportFinding>& findings) {
  const ImportedShape before = model;
  std::vector<ImportFinding> of_sewing, taken_back;
  sew_if_open(model, limits, of_sewing);
  if (!model.shape.IsSame(before.shape)) {
    const TopTools_IndexedMapOfShape changed = changed_faces(before, model, taken_back);
    if (!changed.IsEmpty()) {
      of_sewing.clear();
      model = before;
      ImportedShape others = others_of(before, changed);
      if (others.faces.Extent() > 0) {
        SewingLimits of_others = limits;
        of_others.of_face.clear();
        for (int i = 1; i <= before.faces.Extent() && !limits.of_face.empty(); ++i)
          if (!changed.Contains(before.faces(i))) of_others.of_face.push_back(limits.of_face[i - 1]);
        sew_if_open(others, of_others, of_sewing);
        model = united(others, before, changed);
      }
    }
  }
  findings.insert(findings.end(), of_sewing.begin(), of_sewing.end());
  findings.insert(findings.end(), taken_back.begin(), taken_back.end());
}

}  // namespace st::occt
