#include "geometry/import/sewing.h"

#include <BRepBuilderAPI_Sewing.hxx>
#include <BRep_Tool.hxx>
#include <GCPnts_AbscissaPoint.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <map>
#include <set>

#include "geometry/brep/compound.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/import/bare_surfaces.h"
#include "geometry/import/duplicate_faces.h"
#include "geometry/import/edge_places.h"
#include "geometry/import/false_joins.h"
#include "geometry/import/imprints.h"
#include "geometry/import/original_order.h"
#include "geometry/import/rooms.h"
#include "geometry/import/wild_tolerances.h"

namespace st::occt {
namespace {

constexpr double kSewRelative[] = {1e-6, 1e-5, 1e-4};  // of the diagonal, first that closes the model wins
constexpr double kToleranceGrowth = 10;                // of the sewing tolerance and of what the file had
constexpr double kLessFree = 0.99;                     // of the length of free edges: divided surfaces are taken
constexpr double kNoMoreFree = 1.01;                   // likewise where parts without area are left out

/// A sewn shape and the images in it of faces (first) and named edges of the original.
struct Sewn {
  TopoDS_Shape shape;
  std::vector<TopoDS_Shape> images;
  int n_free = 0;
  int n_false = 0;             ///< edges that joined what does not belong together
  double tolerance = 0;        ///< that it was sewn with
  double group_tolerance = 0;  ///< that groups of it were sewn with before
  double edge_tolerance = 0;   ///< largest of its edges

  /// Edges that are free, or should be.
  int n_open() const { return n_free + 2 * n_false; }
};

/// Edges further apart are no partners. `before`: the largest tolerance of an edge then.
double reasonable_tolerance(double tolerance, double before) { return kToleranceGrowth * std::max(tolerance, before); }

/// Counts what is free or false.
void judge(Sewn& sewn, double reasonable) {
  sewn.n_free = count_free_edges(sewn.shape);
  sewn.edge_tolerance = max_edge_tolerance(sewn.shape);
  TopTools_IndexedMapOfShape edges;
  for (const FalseJoin& join : find_false_joins(sewn.shape, reasonable)) edges.Add(join.edge);
  sewn.n_false = edges.Extent();
}

TopTools_IndexedMapOfShape all_of(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
  TopTools_IndexedMapOfShape all;
  TopExp::MapShapes(shape, kind, all);
  return all;
}

bool keeps_faces(const Sewn& sewn, int n_faces) {
  const TopTools_IndexedMapOfShape faces = all_of(sewn.shape, TopAbs_FACE);
  if (faces.Extent() != n_faces) return false;
  for (int i = 0; i < n_faces; ++i)
    if (!faces.Contains(sewn.images[i])) return false;
  return true;
}

enum class FacesAtEdge { kTwo, kAny };
enum class ShortEdges { kStay, kArePoints };

/// Sews what `before` has; nothing when OpenCASCADE fails.
std::optional<Sewn> sew(const Sewn& before, const std::vector<TopoDS_Shape>& parts, double tolerance,
                        FacesAtEdge how = FacesAtEdge::kTwo, ShortEdges short_edges = ShortEdges::kStay) {
  try {
    BRepBuilderAPI_Sewing sewing(tolerance);
    sewing.SetNonManifoldMode(how == FacesAtEdge::kAny);
    if (short_edges == ShortEdges::kArePoints) sewing.SetMinTolerance(tolerance);
    for (const TopoDS_Shape& part : parts) sewing.Add(part);
    sewing.Perform();
    Sewn after = before;
    after.shape = sewing.SewedShape();
    after.tolerance = tolerance;
    if (after.shape.IsNull()) return std::nullopt;
    for (TopoDS_Shape& image : after.images)
      if (sewing.IsModifiedSubShape(image)) image = sewing.ModifiedSubShape(image);
    return after;
  } catch (const Standard_Failure&) {
    return std::nullopt;
  }
}

/// Faces of one component: those of a part, and of single-face parts those of one name.
std::vector<std::vector<int>> components(const ImportedShape& model) {
  std::map<std::int32_t, int> part_faces;
  for (const FaceAttributes& a : model.attributes) ++part_faces[a.part_index];
  std::map<std::pair<std::int32_t, std::string>, std::vector<int>> groups;
  for (std::size_t i = 0; i < model.attributes.size(); ++i) {
    const FaceAttributes& a = model.attributes[i];
    groups[{part_faces.size() > 1 && part_faces[a.part_index] > 1 ? a.part_index : -1,
            a.name.empty() ? a.part : a.name}]
        .push_back(static_cast<int>(i));
  }
  std::vector<std::vector<int>> result;
  for (auto& [key, faces] : groups) result.push_back(std::move(faces));
  return result;
}

/// Partners are sought inside each component first: coincident edges of two components are joined only where nothing
/// else is left.
std::optional<Sewn> sew_by_component(const ImportedShape& model, const Sewn& before, double tolerance) {
  const std::vector<std::vector<int>> groups = components(model);
  if (groups.size() < 2) return std::nullopt;
  std::optional<Sewn> state = before;
  std::vector<TopoDS_Shape> parts;
  for (const std::vector<int>& group : groups) {
    std::vector<TopoDS_Shape> members;
    for (int i : group) members.push_back(state->images[i]);
    state = sew(*state, members, tolerance);
    if (!state) return std::nullopt;
    parts.push_back(state->shape);
  }
  return sew(*state, parts, tolerance);
}

/// Faces with tolerances of their own, sewn among themselves: those of at least each tolerance with it, the smallest
/// first. They and the other faces are in one compound, which is still to be sewn; the original where nothing is
/// gained.
Sewn sew_groups(const ImportedShape& model, const Sewn& original, const std::vector<double>& of_face) {
  std::set<double> tolerances(of_face.begin(), of_face.end());
  tolerances.erase(0);
  Sewn state = original;
  for (const double tolerance : tolerances) {
    std::vector<TopoDS_Shape> members;
    for (std::size_t f = 0; f < of_face.size(); ++f)
      if (of_face[f] >= tolerance) members.push_back(state.images[f]);
    std::optional<Sewn> sewn = sew(state, members, tolerance);
    if (!sewn) continue;
    std::vector<TopoDS_Shape> all = {sewn->shape};
    for (std::size_t f = 0; f < of_face.size(); ++f)
      if (of_face[f] < tolerance) all.push_back(sewn->images[f]);
    sewn->shape = compound_of(all);
    if (!keeps_faces(*sewn, model.faces.Extent())) continue;
    judge(*sewn, reasonable_tolerance(tolerance, original.edge_tolerance));
    sewn->group_tolerance = tolerance;
    if (sewn->n_open() < state.n_open() && sewn->n_false == 0) state = *sewn;
  }
  return state;
}

/// Fewer free edges first, then smaller edge tolerance; a result whose tolerance has grown beyond reason only when
/// there is no other.
bool is_better(const Sewn& a, const Sewn& b, double reasonable) {
  const bool wild_a = a.edge_tolerance > reasonable, wild_b = b.edge_tolerance > reasonable;
  if (wild_a != wild_b) return wild_b;
  if (a.n_open() != b.n_open()) return a.n_open() < b.n_open();
  return a.edge_tolerance < 0.5 * b.edge_tolerance;
}

/// The sewn shape takes the model's place.
void take_over(ImportedShape& model, const Sewn& sewn) {
  const int n_faces = model.faces.Extent();
  const std::vector<TopoDS_Shape> face_images(sewn.images.begin(), sewn.images.begin() + n_faces);
  for (std::size_t k = 0; k < model.edge_names.size(); ++k) model.edge_names[k].first = sewn.images[n_faces + k];
  const TopTools_IndexedMapOfShape originals = model.faces;
  model.replace(in_original_order(sewn.shape, face_images),
                [&](const TopoDS_Shape& face) { return face_images[originals.FindIndex(face) - 1]; });
}

ImportFinding sewn_finding(FindingKind kind, const Sewn& before, const Sewn& after, double tolerance) {
  const std::string numbers =
      std::to_string(before.n_free) + " free edges before, " + std::to_string(after.n_free) + " after";
  return {kind, "", {}, tolerance, true, numbers};
}

/// Takes over what was sewn; tolerances beyond reason are set back.
void adopt(ImportedShape& model, const Sewn& original, const Sewn& sewn, std::vector<ImportFinding>& findings) {
  take_over(model, sewn);
  const double tolerance = std::max(sewn.tolerance, sewn.group_tolerance);
  const double reasonable = reasonable_tolerance(tolerance, original.edge_tolerance);
  if (sewn.edge_tolerance <= reasonable) return;
  tighten_tolerances(model.shape, tolerance, reasonable);
  findings.push_back({FindingKind::kSewingTolerance, "", {}, sewn.edge_tolerance, true});
}

/// Ascending. `base`: what the first has to be at least. All lengths in the unit of the shape.
std::vector<double> tolerances_to_try(double diagonal, double base, std::optional<double> largest) {
  std::vector<double> list;
  for (double relative : kSewRelative)
    list.push_back(std::max(relative * diagonal, list.empty() ? std::min(base, 1e-4 * diagonal) : 0.0));
  if (!largest) return list;
  list.erase(std::remove_if(list.begin(), list.end(), [&](double t) { return t >= *largest; }), list.end());
  list.push_back(*largest);
  return list;
}

/// Calls visit(curve, first and last parameter) for each edge that one face has.
template <class Visit>
void for_each_free_curve(const TopoDS_Shape& shape, const Visit& visit) {
  TopTools_IndexedMapOfShape edges;
  const std::vector<int> uses = edge_uses(shape, edges);
  for (int i = 0; i < edges.Extent(); ++i) {
    double t0 = 0, t1 = 0;
    if (uses[i] != 1 || BRep_Tool::Degenerated(TopoDS::Edge(edges(i + 1)))) continue;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(TopoDS::Edge(edges(i + 1)), t0, t1);
    if (!curve.IsNull()) visit(curve, t0, t1);
  }
}

/// Whether a free edge is within `tolerance` of a point.
bool has_short_free_edge(const TopoDS_Shape& shape, double tolerance) {
  bool has_short = false;
  for_each_free_curve(shape, [&](const Handle(Geom_Curve) & curve, double t0, double t1) {
    const gp_Pnt first = curve->Value(t0), middle = curve->Value(0.5 * (t0 + t1)), last = curve->Value(t1);
    has_short |= std::max({first.Distance(middle), middle.Distance(last), first.Distance(last)}) <= tolerance;
  });
  return has_short;
}

double free_length(const TopoDS_Shape& shape) {
  double length = 0;
  for_each_free_curve(shape, [&](const Handle(Geom_Curve) & curve, double t0, double t1) {
    length += GCPnts_AbscissaPoint::Length(GeomAdaptor_Curve(curve, t0, t1));
  });
  return length;
}

/// The model with the smallest tolerance that closes it, else the one that leaves the fewest free edges; nothing when
/// none helps. After sew_groups() one that leaves as many will do: it makes shells. Short edges become points where
/// that closes the model. So what is free is sewn again: of edges between the same points OCCT joins a pair at a time.
std::optional<Sewn> sew_all(const ImportedShape& model, const Sewn& start, const std::vector<double>& tolerances) {
  const int n_allowed = start.group_tolerance > 0 ? start.n_free : start.n_free - 1;
  std::optional<Sewn> best;
  const auto is_closed_by = [&](std::optional<Sewn> sewn, double tolerance) {
    const double reasonable = reasonable_tolerance(tolerance, start.edge_tolerance);
    if (sewn && keeps_faces(*sewn, model.faces.Extent())) {
      judge(*sewn, reasonable);
      if (sewn->n_open() <= n_allowed && (!best || is_better(*sewn, *best, reasonable))) best = sewn;
    }
    return best && best->n_open() == 0 && best->edge_tolerance <= reasonable;
  };
  for (const double tolerance : tolerances) {
    if (is_closed_by(sew(start, {start.shape}, tolerance), tolerance)) return best;
    if (is_closed_by(sew_by_component(model, start, tolerance), tolerance)) return best;
  }
  for (const double tolerance : tolerances) {
    if (!(best && best->n_false > 0) && !has_short_free_edge(best ? best->shape : start.shape, tolerance)) continue;
    const std::optional<Sewn> before = best;
    if (is_closed_by(sew(start, {start.shape}, tolerance, FacesAtEdge::kTwo, ShortEdges::kArePoints), tolerance))
      return best;
    best = before;
  }
  const std::optional<Sewn> once = best;
  if (once && !is_closed_by(sew(*once, {once->shape}, once->tolerance), once->tolerance)) best = once;
  return best;
}

ImportFinding false_join_finding(int face, const FalseJoin& join) {
  const Box3 box = rough_box(join.edge);
  return {FindingKind::kUndoneRepair,
          "face " + std::to_string(face + 1),
          box.center(),
          join.distance,
          false,
          join.distance > 0 ? "sewn, it would end " + format_number(join.distance) + " away from its edge"
                            : "sewn, it and its neighbours could not agree which side is outside"};
}

/// Sewn again, as `wrong` was, without the faces at false edges, each of which is said; nothing where that joins
/// nothing.
std::optional<Sewn> sew_without_false_joins(const ImportedShape& model, const Sewn& start, Sewn wrong,
                                            std::vector<ImportFinding>& findings) {
  constexpr int kMostPasses = 4;
  std::set<int> left_out;
  for (int pass = 0; pass < kMostPasses; ++pass) {
    const double reasonable = reasonable_tolerance(wrong.tolerance, start.edge_tolerance);
    for (const FalseJoin& join : find_false_joins(wrong.shape, reasonable))
      for (int i = 0; i < model.faces.Extent(); ++i)
        if (wrong.images[i].IsSame(join.face) && left_out.insert(i).second)
          findings.push_back(false_join_finding(i, join));
    std::vector<TopoDS_Shape> parts, all;
    for (int i = 0; i < model.faces.Extent(); ++i) (left_out.count(i) > 0 ? all : parts).push_back(start.images[i]);
    if (parts.empty()) return std::nullopt;
    std::optional<Sewn> sewn = sew(start, parts, wrong.tolerance);
    if (!sewn) return std::nullopt;
    const std::vector<TopoDS_Shape> pieces = pieces_of(sewn->shape);
    all.insert(all.begin(), pieces.begin(), pieces.end());
    sewn->shape = compound_of(all);
    if (!keeps_faces(*sewn, model.faces.Extent())) return std::nullopt;
    judge(*sewn, reasonable);
    if (sewn->n_false == 0) return sewn->n_free < start.n_free ? sewn : std::nullopt;
    wrong = std::move(*sewn);
  }
  return std::nullopt;
}

/// `now` (made of `start`) with free edges joined to edges that two faces have already, and edges of open pieces at one
/// place. Other pieces stay as they are: bodies that touch each other keep their own. Nothing where no edge goes.
std::optional<Sewn> sew_third_faces(const ImportedShape& model, const Sewn& start, const Sewn& now, double tolerance) {
  const std::vector<TopoDS_Shape> pieces = pieces_of(now.shape);
  const std::vector<char> is_sewn = have_edges_at_one_place(pieces, tolerance);
  TopTools_IndexedMapOfShape others;
  std::vector<TopoDS_Shape> parts, all;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    if (is_sewn[p]) continue;
    all.push_back(pieces[p]);
    for (const TopAbs_ShapeEnum kind : {TopAbs_FACE, TopAbs_EDGE}) TopExp::MapShapes(pieces[p], kind, others);
  }
  const int n_faces = model.faces.Extent();
  for (int i = 0; i < n_faces; ++i)
    if (!others.Contains(now.images[i])) parts.push_back(start.images[i]);
  if (parts.empty()) return std::nullopt;
  std::optional<Sewn> sewn = sew(start, parts, tolerance, FacesAtEdge::kAny);
  if (!sewn) return std::nullopt;
  for (std::size_t i = 0; i < now.images.size(); ++i)
    if (others.Contains(now.images[i])) sewn->images[i] = now.images[i];
  all.push_back(sewn->shape);
  sewn->shape = compound_of(pieces_of(compound_of(all)));
  if (!keeps_faces(*sewn, n_faces)) return std::nullopt;
  const double reasonable = reasonable_tolerance(tolerance, now.edge_tolerance);
  judge(*sewn, reasonable);
  const auto n_edges = [](const TopoDS_Shape& shape) { return all_of(shape, TopAbs_EDGE).Extent(); };
  const auto rank = [&](const Sewn& s) { return std::pair(s.n_open(), n_edges(s.shape)); };
  const bool is_joined = rank(*sewn) < rank(now);
  if (!is_joined || sewn->n_false > 0 || sewn->edge_tolerance > reasonable) return std::nullopt;
  return sewn;
}

/// Free edges joined two by two; the model is still as it was.
struct Pairs {
  Sewn original, start;      ///< and with what groups' tolerances join
  std::optional<Sewn> best;  ///< nothing: no tolerance helps
  std::vector<double> tolerances;
  bool is_group_sewn = false;

  const Sewn& now() const { return best ? *best : start; }
};

Pairs sew_pairs(ImportedShape& model, const SewingLimits& limits, std::vector<ImportFinding>& findings) {
  Pairs pairs;
  Sewn& original = pairs.original;
  original.shape = model.shape;
  original.n_free = count_free_edges(model.shape);
  for (int i = 1; i <= model.faces.Extent(); ++i) original.images.push_back(model.faces(i));
  for (const auto& [edge, name] : model.edge_names) original.images.push_back(edge);
  original.edge_tolerance = max_edge_tolerance(model.shape);
  pairs.start = sew_groups(model, original, limits.of_face);
  const Sewn& start = pairs.start;
  pairs.is_group_sewn = start.n_free < original.n_free;
  for (std::size_t f = 0; pairs.is_group_sewn && f < limits.of_face.size(); ++f)
    model.attributes[f].is_sewn_by_group = limits.of_face[f] > 0;
  if (pairs.is_group_sewn)
    findings.push_back(sewn_finding(FindingKind::kSewnByGroup, original, start, start.group_tolerance));
  const double base = std::max(2 * original.edge_tolerance, limits.stated_resolution);
  pairs.tolerances = tolerances_to_try(model.box().diagonal(), base, limits.largest);
  pairs.best = sew_all(model, start, pairs.tolerances);
  if (pairs.best && pairs.best->n_false > 0) pairs.best = sew_without_false_joins(model, start, *pairs.best, findings);
  if (pairs.best && pairs.best->n_free < start.n_free)
    findings.push_back(sewn_finding(FindingKind::kSewn, start, *pairs.best, pairs.best->tolerance));
  return pairs;
}

/// The model as it is sewn, with third faces where edges are left.
void take_pairs(ImportedShape& model, const Pairs& pairs, std::vector<ImportFinding>& findings) {
  const Sewn& now = pairs.now();
  const double tolerance = pairs.best ? now.tolerance : pairs.tolerances.front();
  const std::optional<Sewn> third = now.n_free > 0 ? sew_third_faces(model, pairs.start, now, tolerance) : std::nullopt;
  if (third) findings.push_back(sewn_finding(FindingKind::kThirdFace, now, *third, tolerance));
  if (third || pairs.best || pairs.is_group_sewn) adopt(model, pairs.original, third ? *third : now, findings);
  if (now.n_free == 0) return;
  const Imprints which = third ? Imprints::kEdgesAndFaces : Imprints::kEdges;
  if (!imprint_faces(model, which, pairs.tolerances.back(), findings) && !third) return;
  share_common_faces(model, findings);
  divide_into_rooms(model, findings);
}

}  // namespace

void sew_if_open(ImportedShape& model, const SewingLimits& limits, std::vector<ImportFinding>& findings) {
  if (count_free_edges(model.shape) == 0) return;
  ImportedShape divided = model;
  std::vector<ImportFinding> own, of_divided;
  const Pairs pairs = sew_pairs(model, limits, own);
  bool is_divided = false;
  if (pairs.now().n_open() > 0 && limits.of_face.empty())
    if (const DividedSurfaces parts = divide_bare_surfaces(divided, of_divided); parts.any) {
      take_pairs(divided, sew_pairs(divided, limits, of_divided), of_divided);
      const double share = parts.has_empty_parts ? kNoMoreFree : kLessFree;
      is_divided = free_length(divided.shape) < share * free_length(pairs.now().shape);
    }
  if (!is_divided) take_pairs(model, pairs, own);
  if (is_divided) model = divided, own = of_divided;
  findings.insert(findings.end(), own.begin(), own.end());
}

}  // namespace st::occt
