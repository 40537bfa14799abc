#include "geometry/import/duplicate_faces.h"

#include <BRepTools_ReShape.hxx>
#include <BRep_Tool.hxx>
#include <GeomAPI_ProjectPointOnSurf.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/brep/face_integral.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/import/import.h"
#include "geometry/model/sameness.h"

namespace st::occt {
namespace {

struct Candidate {
  int id;
  TopoDS_Face face;
  Box3 box;
  double tolerance;
  bool is_loose;  ///< in no solid
};

Candidate candidate(const TopoDS_Shape& face, int id) {
  return {id, TopoDS::Face(face.Oriented(TopAbs_FORWARD)), rough_box(face), max_edge_tolerance(face), false};
}

/// All faces in the order of their boxes; none when all belong to solids.
std::vector<Candidate> candidates(const ImportedShape& model) {
  std::vector<char> is_loose(model.faces.Extent() + 1, 0);
  for (TopExp_Explorer e(model.shape, TopAbs_FACE, TopAbs_SOLID); e.More(); e.Next())
    is_loose[model.faces.FindIndex(e.Current())] = 1;
  std::vector<Candidate> result;
  if (std::find(is_loose.begin(), is_loose.end(), 1) == is_loose.end()) return result;
  for (int i = 1; i <= model.faces.Extent(); ++i) {
    result.push_back(candidate(model.faces(i), i));
    result.back().is_loose = is_loose[i] != 0;
  }
  std::sort(result.begin(), result.end(), [](const Candidate& a, const Candidate& b) {
    return a.box.lo.x != b.box.lo.x ? a.box.lo.x < b.box.lo.x : a.id < b.id;
  });
  return result;
}

std::vector<Vec3> vertices(const TopoDS_Face& face) {
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(face, TopAbs_VERTEX, map);
  std::vector<Vec3> result;
  for (int i = 1; i <= map.Extent(); ++i) result.push_back(vec(BRep_Tool::Pnt(TopoDS::Vertex(map(i)))));
  return result;
}

bool same_name(const ImportedShape& model, int a, int b) {
  const FaceAttributes &x = model.attributes[a - 1], &y = model.attributes[b - 1];
  return x.name == y.name && x.part == y.part;
}

bool all_near(const std::vector<Vec3>& a, const std::vector<Vec3>& b, double tolerance) {
  return std::all_of(a.begin(), a.end(), [&](Vec3 p) {
    return std::any_of(b.begin(), b.end(), [&](Vec3 q) { return distance(p, q) <= tolerance; });
  });
}

bool same_surface(const FaceDomain& a, const TopoDS_Face& b, double tolerance) {
  const Vec3 p = a.surface->point({0.5 * (a.bounds.lo.x + a.bounds.hi.x), 0.5 * (a.bounds.lo.y + a.bounds.hi.y)});
  GeomAPI_ProjectPointOnSurf projection(gp_Pnt(p.x, p.y, p.z), BRep_Tool::Surface(b));
  return projection.NbPoints() > 0 && projection.LowerDistance() <= tolerance;
}

bool coincide(const Candidate& a, const Candidate& b, double tolerance) {
  if (distance(a.box.lo, b.box.lo) > 2 * tolerance || distance(a.box.hi, b.box.hi) > 2 * tolerance) return false;
  const std::vector<Vec3> va = vertices(a.face), vb = vertices(b.face);
  if (va.size() != vb.size() || !all_near(va, vb, tolerance) || !all_near(vb, va, tolerance)) return false;
  const FaceDomain da = make_domain(a.face);
  const double area_a = std::fabs(integrate_face(da, {}).area),
               area_b = std::fabs(integrate_face(make_domain(b.face), {}).area);
  return std::fabs(area_a - area_b) <= kSameArea * area_a && same_surface(da, b.face, tolerance);
}

/// For each set of edges that several faces have, these faces in order; empty where no edge has more than two faces.
std::vector<std::vector<int>> faces_of_same_edges(const ImportedShape& model) {
  TopTools_IndexedMapOfShape edges;
  const std::vector<int> uses = edge_uses(model.shape, edges);
  if (std::none_of(uses.begin(), uses.end(), [](int n) { return n > 2; })) return {};
  std::map<std::vector<int>, std::vector<int>> by_edges;
  for (int i = 1; i <= model.faces.Extent(); ++i) {
    TopTools_IndexedMapOfShape own;
    TopExp::MapShapes(model.faces(i), TopAbs_EDGE, own);
    std::vector<int> key;
    for (int k = 1; k <= own.Extent(); ++k)
      if (!BRep_Tool::Degenerated(TopoDS::Edge(own(k)))) key.push_back(edges.FindIndex(own(k)));
    std::sort(key.begin(), key.end());
    by_edges[key].push_back(i);
  }
  std::vector<std::vector<int>> result;
  for (auto& [key, faces] : by_edges)
    if (faces.size() > 1) result.push_back(std::move(faces));
  return result;
}

/// Normals of the surfaces, not of the faces. Precondition: they lie on each other.
bool same_side(const FaceDomain& a, const TopoDS_Face& b) {
  const Vec2 middle = {0.5 * (a.bounds.lo.x + a.bounds.hi.x), 0.5 * (a.bounds.lo.y + a.bounds.hi.y)};
  const SurfacePoint at = a.surface->evaluate(middle);
  const Vec3 n = cross(at.du, at.dv);
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(b);
  const GeomAPI_ProjectPointOnSurf projection(gp_Pnt(at.x.x, at.x.y, at.x.z), surface);
  double u, v;
  projection.LowerDistanceParameters(u, v);
  gp_Pnt q;
  gp_Vec du, dv;
  surface->D1(u, v, q, du, dv);
  return du.Crossed(dv).Dot({n.x, n.y, n.z}) > 0;
}

/// Whether one shell has both faces, on the same side of it.
bool are_in_same_shell(const TopTools_IndexedDataMapOfShapeListOfShape& shells_of, const TopoDS_Shape& a,
                       const TopoDS_Shape& b, bool is_turned) {
  if ((a.Orientation() == b.Orientation()) == is_turned || !shells_of.Contains(a) || !shells_of.Contains(b))
    return false;
  const TopTools_ListOfShape &of_a = shells_of.FindFromKey(a), &of_b = shells_of.FindFromKey(b);
  return std::any_of(of_a.begin(), of_a.end(), [&](const TopoDS_Shape& shell) {
    return std::any_of(of_b.begin(), of_b.end(), [&](const TopoDS_Shape& other) { return other.IsSame(shell); });
  });
}

/// A solid with its faces in any order.
struct SolidCandidate {
  TopoDS_Shape solid;
  Box3 box;
  std::vector<Candidate> faces;
};

SolidCandidate solid_candidate(const TopoDS_Shape& solid) {
  SolidCandidate result{solid, rough_box(solid), {}};
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(solid, TopAbs_FACE, faces);
  for (int i = 1; i <= faces.Extent(); ++i) result.faces.push_back(candidate(faces(i), i));
  return result;
}

/// Whether each face of one solid is at the place of a face of the other.
bool are_twins(const SolidCandidate& a, const SolidCandidate& b, double place) {
  if (distance(a.box.lo, b.box.lo) > 2 * place || distance(a.box.hi, b.box.hi) > 2 * place) return false;
  if (a.faces.size() != b.faces.size()) return false;
  const auto has_partner = [&](const Candidate& face) {
    return std::any_of(b.faces.begin(), b.faces.end(), [&](const Candidate& other) {
      return coincide(face, other, std::max({place, face.tolerance, other.tolerance}));
    });
  };
  return std::all_of(a.faces.begin(), a.faces.end(), has_partner);
}

}  // namespace

void remove_duplicate_solids(ImportedShape& model, std::vector<ImportFinding>& findings) {
  TopTools_IndexedMapOfShape solids;
  TopExp::MapShapes(model.shape, TopAbs_SOLID, solids);
  if (solids.Extent() < 2) return;
  const double place = kSamePlace * model.box().diagonal();
  std::vector<SolidCandidate> kept;
  const Handle(BRepTools_ReShape) reshape = new BRepTools_ReShape;
  for (int i = 1; i <= solids.Extent(); ++i) {
    SolidCandidate solid = solid_candidate(solids(i));
    const auto twin = std::find_if(kept.begin(), kept.end(),
                                   [&](const SolidCandidate& other) { return are_twins(solid, other, place); });
    if (twin == kept.end()) {
      kept.push_back(std::move(solid));
      continue;
    }
    reshape->Remove(solid.solid);
    findings.push_back({FindingKind::kDuplicateSolid, "solid " + std::to_string(i) + " of the file", solid.box.center(),
                        solid.box.diagonal(), true, std::to_string(solids.FindIndex(twin->solid))});
  }
  if (kept.size() == static_cast<std::size_t>(solids.Extent())) return;
  model.replace(reshape->Apply(model.shape), [&](const TopoDS_Shape& face) { return face; });
}

void share_common_faces(ImportedShape& model, std::vector<ImportFinding>& findings) {
  const std::vector<std::vector<int>> alike = faces_of_same_edges(model);
  if (alike.empty()) return;
  const double place = kSamePlace * model.box().diagonal();
  const Handle(BRepTools_ReShape) reshape = new BRepTools_ReShape;
  TopTools_IndexedDataMapOfShapeListOfShape shells_of;
  TopExp::MapShapesAndAncestors(model.shape, TopAbs_FACE, TopAbs_SHELL, shells_of);
  bool is_changed = false;
  for (const std::vector<int>& faces : alike) {
    std::vector<Candidate> kept;
    for (const int id : faces) {
      const Candidate face = candidate(model.faces(id), id);
      const auto twin = std::find_if(kept.begin(), kept.end(), [&](const Candidate& other) {
        return coincide(other, face, std::max({place, face.tolerance, other.tolerance}));
      });
      if (twin == kept.end()) {
        kept.push_back(face);
        continue;
      }
      const bool is_turned = !same_side(make_domain(twin->face), face.face);
      if (are_in_same_shell(shells_of, model.faces(twin->id), model.faces(id), is_turned))
        reshape->Remove(face.face);  // shared, the shell would have it twice
      else
        reshape->Replace(face.face, twin->face.Oriented(is_turned ? TopAbs_REVERSED : TopAbs_FORWARD));
      is_changed = true;
      findings.push_back({FindingKind::kDuplicateFace, model.file_label(id), face.box.center(), face.box.diagonal(),
                          true, model.file_label(twin->id)});
    }
  }
  if (is_changed) model.replace(reshape->Apply(model.shape), [](const TopoDS_Shape& face) { return face; });
}

void remove_duplicates(ImportedShape& model, std::vector<ImportFinding>& findings) {
  const std::vector<Candidate> faces = candidates(model);
  if (faces.empty()) return;
  const double place = kSamePlace * model.box().diagonal();
  const Handle(BRepTools_ReShape) reshape = new BRepTools_ReShape;
  std::vector<char> is_removed(faces.size(), 0);
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (std::size_t k = i + 1; k < faces.size(); ++k) {
      const double tolerance = std::max({place, faces[i].tolerance, faces[k].tolerance});
      if (faces[k].box.lo.x - faces[i].box.lo.x > 2 * tolerance) break;
      if (!faces[i].is_loose && !faces[k].is_loose) continue;
      if (is_removed[i] || is_removed[k] || !same_name(model, faces[i].id, faces[k].id) ||
          !coincide(faces[i], faces[k], tolerance))
        continue;
      const bool keep_i = faces[i].is_loose == faces[k].is_loose ? faces[i].id < faces[k].id : !faces[i].is_loose;
      const Candidate& gone = keep_i ? faces[k] : faces[i];
      is_removed[keep_i ? k : i] = 1;
      reshape->Remove(gone.face);
      findings.push_back({FindingKind::kDuplicateFace, model.file_label(gone.id), gone.box.center(),
                          gone.box.diagonal(), true, model.file_label(keep_i ? faces[i].id : faces[k].id)});
    }
  if (std::find(is_removed.begin(), is_removed.end(), 1) == is_removed.end()) return;
  model.replace(reshape->Apply(model.shape), [&](const TopoDS_Shape& face) { return reshape->Apply(face); });
}

}  // namespace st::occt
