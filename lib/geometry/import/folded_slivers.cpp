#include "geometry/import/folded_slivers.h"

#include <BRepTools_ReShape.hxx>
#include <BRep_Tool.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "geometry/brep/face_domain.h"
#include "geometry/brep/occt_evaluators.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/brep/uv_box.h"
#include "geometry/import/edge_spurs.h"
#include "geometry/model/cad_tolerance.h"
#include "geometry/model/sameness.h"
#include "geometry/shape/loop_polygons.h"
#include "geometry/shape/projection.h"

namespace st::occt {
namespace {

constexpr double kSmall = 0.25;    // of the neighbour's area: a larger face is no sliver
constexpr double kOn = 3;          // tolerances: how far from its neighbour's surface it may be
constexpr double kLeftArea = 0.5;  // of the sliver's area: how far the neighbour's may be from what should be left
constexpr int kAcross = 12;        // samples of the sliver in u and in v,
constexpr int kAlong = 24;         // and of each of its edges

/// What of both chains bounds them as one face; nullopt where an edge of the sliver is used twice, or the same way by
/// both.
std::optional<EdgeChain> sum_of(EdgeChain own, EdgeChain slivers) {
  std::size_t n_shared = 0;
  for (std::size_t k = 0; k < slivers.size();) {
    const auto same = [&](const TopoDS_Edge& e) { return e.IsSame(slivers[k]); };
    if (std::count_if(slivers.begin(), slivers.end(), same) > 1 || std::count_if(own.begin(), own.end(), same) > 1)
      return std::nullopt;
    const auto it = std::find_if(own.begin(), own.end(), same);
    if (it == own.end()) {
      ++k;
      continue;
    }
    if (it->Orientation() == slivers[k].Orientation()) return std::nullopt;
    own.erase(it);
    slivers.erase(slivers.begin() + static_cast<std::ptrdiff_t>(k));
    ++n_shared;
  }
  if (n_shared == 0) return std::nullopt;
  own.insert(own.end(), slivers.begin(), slivers.end());
  return own;
}

/// What becomes of a sliver and its neighbour.
struct Merge {
  std::map<FaceId, TopoDS_Face> faces;                     ///< oriented forward: the neighbour with the sliver in it,
                                                           ///< and others at edges that became one
  std::vector<std::pair<TopoDS_Edge, TopoDS_Edge>> rests;  ///< edges that were cut, and what is left of them
};

class SliverMerger {
 public:
  SliverMerger(const ImportedShape& model, const ModelTables& t)
      : model_(model), t_(t), least_(kSamePlace * t.box().diagonal()) {}

  /// nullopt where that cannot be.
  std::optional<Merge> merge(FaceId sliver, FaceId neighbour) const {
    const TopoDS_Face a = forward(sliver), b = forward(neighbour);
    const double on = kOn * std::max({least_, cad_tolerance(t_, sliver), cad_tolerance(t_, neighbour)});
    const auto surface = make_surface(BRep_Tool::Surface(b), uv_box(b));
    if (!lies_on(a, *surface, on)) return std::nullopt;
    std::vector<EdgeChain> own = chains_of(b), slivers = chains_of(a);
    if (own.empty() || slivers.size() != 1) return std::nullopt;
    if (model_.faces(sliver + 1).Orientation() != model_.faces(neighbour + 1).Orientation())
      for (TopoDS_Edge& e : slivers[0]) e.Reverse();
    for (EdgeChain& chain : own)
      if (const auto sum = sum_of(chain, slivers[0])) {
        chain = *sum;
        for (const TopoDS_Edge& e : slivers[0])
          if (is_of(chain, e) && !add_pcurve(e, b, on)) return std::nullopt;
        Merge merge;
        while (const auto spur = find_spur(chain, slivers[0], on)) {
          chain = without_spur(chain, *spur);
          if (!share_spur(model_, *spur, {sliver, neighbour}, merge.faces)) return std::nullopt;
          if (!spur->rest.IsNull()) merge.rests.emplace_back(spur->longer, spur->rest);
        }
        if (!runs_clear(chain, slivers[0], on)) return std::nullopt;
        const double area = t_.face_area[neighbour] - t_.face_area[sliver];
        const auto face = face_of_chains(b, own, area, kLeftArea * t_.face_area[sliver]);
        if (!face) return std::nullopt;
        merge.faces.insert({neighbour, *face});
        return merge;
      }
    return std::nullopt;
  }

  /// The chords of common edges.
  double shared_length(FaceId a, FaceId b) const {
    const auto of_b = t_.edges_of(b);
    double length = 0;
    for (const EdgeId e : t_.edges_of(a))
      if (std::find(of_b.begin(), of_b.end(), e) != of_b.end())
        length += distance(t_.vertex_xyz[t_.edge_vertices[2 * e]], t_.vertex_xyz[t_.edge_vertices[2 * e + 1]]);
    return length;
  }

 private:
  TopoDS_Face forward(FaceId f) const { return TopoDS::Face(model_.faces(f + 1).Oriented(TopAbs_FORWARD)); }

  /// Whether no edge of the sliver runs along another one, there and back.
  static bool runs_clear(const EdgeChain& chain, const EdgeChain& added, double on) {
    for (const TopoDS_Edge& e : added) {
      if (!is_of(chain, e)) continue;  // a common edge, gone
      double t0, t1;
      const Handle(Geom_Curve) curve = BRep_Tool::Curve(e, t0, t1);
      const Vec3 middle = vec(curve->Value(0.5 * (t0 + t1)));
      for (const TopoDS_Edge& other : chain) {
        const Handle(Geom_Curve) c = BRep_Tool::Curve(other, t0, t1);
        if (c.IsNull() || other.IsSame(e)) continue;
        if (closest_point(*make_curve(c, t0, t1), middle).distance <= on) return false;
      }
    }
    return true;
  }
  static bool is_of(const EdgeChain& chain, const TopoDS_Edge& edge) {
    return std::any_of(chain.begin(), chain.end(), [&](const TopoDS_Edge& e) { return e.IsSame(edge); });
  }

  static bool lies_on(const TopoDS_Face& face, const Surface& surface, double on) {
    const auto is_on = [&](Vec3 x) { return closest_point(surface, x).distance <= on; };
    for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
      double t0, t1;
      const Handle(Geom_Curve) curve = BRep_Tool::Curve(TopoDS::Edge(e.Current()), t0, t1);
      if (curve.IsNull()) return false;
      for (int k = 0; k <= kAlong; ++k)
        if (!is_on(vec(curve->Value(t0 + (t1 - t0) * k / kAlong)))) return false;
    }
    const FaceDomain d = make_domain(face);
    std::vector<LoopSide> sides;
    for (const LoopUv& loop : d.loops) {
      const std::vector<Vec2> p = loop.polygon();
      for (std::size_t k = 0; k < p.size(); ++k) sides.push_back({p[k], p[(k + 1) % p.size()]});
    }
    const LoopPolygons loops(std::move(sides));
    const Box2& b = d.bounds;
    for (int i = 1; i < kAcross; ++i)
      for (int j = 1; j < kAcross; ++j) {
        const Vec2 uv{b.lo.x + (b.hi.x - b.lo.x) * i / kAcross, b.lo.y + (b.hi.y - b.lo.y) * j / kAcross};
        if (loops.contains(uv) && !is_on(d.surface->point(uv))) return false;
      }
    return true;
  }

  const ImportedShape& model_;
  const ModelTables& t_;
  double least_;
};

struct Fold {
  FaceId sliver, neighbour;
  double shared;  // length
  Vec3 xyz;
};

/// Longest common edges first: there the sliver belongs.
std::vector<Fold> folds_of(const ModelTables& t, const std::vector<FaceCrossing>& found, const SliverMerger& merger) {
  std::vector<Fold> folds;
  for (const FaceCrossing& c : found) {
    if (!c.is_overlap) continue;
    const bool first_is_small = t.face_area[c.first] < t.face_area[c.second];
    const FaceId sliver = first_is_small ? c.first : c.second, neighbour = first_is_small ? c.second : c.first;
    if (t.face_area[sliver] <= kSmall * t.face_area[neighbour])
      folds.push_back({sliver, neighbour, merger.shared_length(sliver, neighbour), c.xyz});
  }
  std::stable_sort(folds.begin(), folds.end(), [](const Fold& a, const Fold& b) { return a.shared > b.shared; });
  return folds;
}

}  // namespace

bool merge_folded_slivers(ImportedShape& model, const ModelTables& t, const std::vector<FaceCrossing>& found,
                          std::vector<ImportFinding>& findings) {
  const SliverMerger merger(model, t);
  const Handle(BRepTools_ReShape) reshape = new BRepTools_ReShape;
  std::set<FaceId> changed;
  std::vector<ImportFinding> merged;
  for (const Fold& fold : folds_of(t, found, merger)) try {
      if (changed.contains(fold.sliver) || changed.contains(fold.neighbour)) continue;
      const auto merge = merger.merge(fold.sliver, fold.neighbour);
      const auto is_changed = [&](const auto& face) { return changed.contains(face.first); };
      if (!merge || std::any_of(merge->faces.begin(), merge->faces.end(), is_changed)) continue;
      reshape->Remove(model.faces(fold.sliver + 1));
      changed.insert(fold.sliver);
      for (const auto& [f, face] : merge->faces) {
        reshape->Replace(model.faces(f + 1).Oriented(TopAbs_FORWARD), face);
        changed.insert(f);
      }
      for (const auto& [whole, rest] : merge->rests)
        for (auto& [edge, name] : model.edge_names)
          if (edge.IsSame(whole)) edge = rest;
      merged.push_back({FindingKind::kMergedSliver, t.face_label(fold.sliver), fold.xyz,
                        t.face_box[fold.sliver].diagonal(), true, t.face_label(fold.neighbour)});
    } catch (const Standard_Failure&) {  // stays as it is
    }
  if (merged.empty()) return false;
  if (!model.replace(reshape->Apply(model.shape), [&](const TopoDS_Shape& face) { return reshape->Apply(face); }))
    return false;
  findings.insert(findings.end(), merged.begin(), merged.end());
  return true;
}

}  // namespace st::occt
