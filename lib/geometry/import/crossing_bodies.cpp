#include "geometry/import/crossing_bodies.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRep_Tool.hxx>
#include <IntCurvesFace_Intersector.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "base/boxes.h"
#include "geometry/brep/occt_evaluators.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/model/bodies.h"
#include "geometry/shape/projection.h"

namespace st::occt {
namespace {

constexpr double kTouching = 1e-6;  // of the diagonal: the tolerance of places
constexpr double kDeep = 10;        // times that, on both sides of a face: an edge goes through it
constexpr double kStep = 0.02;      // of the edge, to look at both sides

/// Of a comparison: some microseconds.
int cost_of(SurfaceType type) { return type == SurfaceType::kPlane ? 8 : type < SurfaceType::kBezier ? 200 : 400; }

/// Looks whether an edge can go through a surface, from points of the edge and what is closest to them. Parts that
/// touch have many edges that lie on the other's faces; OpenCASCADE takes a hundred times as long to intersect those.
class ThroughSearch {
 public:
  /// `grid`: of the surface, kept for the next edge.
  ThroughSearch(const BRepAdaptor_Curve& edge, const Surface& surface, SurfaceGrid& grid, double tolerance)
      : edge_(edge), surface_(surface), grid_(grid), tolerance_(tolerance) {}

  bool may_go_through() const {
    constexpr int kHalvings = 5;  // a crossing and the way back within 1/128 of the edge are overlooked
    const double t0 = edge_.FirstParameter(), t1 = edge_.LastParameter();
    Station a = station(t0);
    for (const double share : {0.24, 0.51, 0.77, 1.0}) {  // not the middle, where symmetric models cross
      const Station b = station(t0 + share * (t1 - t0));
      if (may_go_through(a, b, kHalvings)) return true;
      a = b;
    }
    return false;
  }

 private:
  struct Station {
    double t;
    Vec3 x;
    double distance;  // to the surface
    double side;      // likewise, along its normal; 0 on the surface
  };

  Station station(double t) const {
    const Vec3 x = vec(edge_.Value(t));
    const SurfaceFoot foot = closest_point(surface_, x, grid_);
    if (foot.distance <= tolerance_) return {t, x, 0, 0};
    const SurfacePoint p = surface_.evaluate(foot.uv);
    return {t, x, foot.distance, dot(x - foot.x, cross(p.du, p.dv))};
  }

  /// A piece that is on the surface at three places lies on it; one that is further away than it is long is apart.
  bool may_go_through(const Station& a, const Station& b, int halvings) const {
    constexpr double kUneven = 0.47;       // of a piece: as above
    constexpr double kLengthOfArc = 1.25;  // over its two chords: 1.11 for half a circle
    const Station m = station(a.t + kUneven * (b.t - a.t));
    if (m.distance > kLengthOfArc * std::max(distance(a.x, m.x), distance(m.x, b.x))) return false;
    if (a.distance + m.distance + b.distance == 0) return false;
    if (halvings > 0) return may_go_through(a, m, halvings - 1) || may_go_through(m, b, halvings - 1);
    return a.side * m.side < 0 || m.side * b.side < 0;
  }

  const BRepAdaptor_Curve& edge_;
  const Surface& surface_;
  SurfaceGrid& grid_;
  double tolerance_;
};

class CrossingSearch {
 public:
  CrossingSearch(const ImportedShape& model, const ModelTables& t, const FaceMeasures& measures)
      : model_(model), t_(t), box_(measures.edge_box), tolerance_(kTouching * t.box().diagonal()) {
    face_of_edge_.assign(t.n_edges(), kNone);
    for (FaceId f = 0; f < t.n_faces(); ++f)
      for (const EdgeId e : t.edges_of(f))
        if (face_of_edge_[e] == kNone) face_of_edge_[e] = f;
  }

  CrossingBodies find() {
    if (t_.n_solids < 2) return {};
    TopExp::MapShapes(model_.shape, TopAbs_EDGE, edges_);
    intersectors_.resize(t_.n_faces());
    surfaces_.resize(t_.n_faces());
    const std::vector<EdgeId> order = edges_by_place();
    for (FaceId f = 0; f < t_.n_faces(); ++f) collect(f, order);
    for (const int most : {kMostCrossingTests / 20, kMostCrossingTests / 4, kMostCrossingTests})
      for (auto& [bodies, pair] : pairs_) search(pair, most);
    return results();
  }

 private:
  /// To be compared: an edge of one body, a face of the other.
  struct Test {
    FaceId face;
    EdgeId edge;
  };
  struct SampledSurface {
    std::unique_ptr<Surface> surface;
    SurfaceGrid grid;
  };
  struct Pair {
    std::vector<Test> tests;
    std::size_t n_done = 0;
    std::int64_t cost = 0;  // of all that there would be
    int cost_done = 0;
    std::optional<BodyCrossing> found;
  };

  std::vector<EdgeId> edges_by_place() const {
    std::vector<EdgeId> order;
    for (EdgeId e = 0; e < t_.n_edges(); ++e)
      if (!t_.edge_is_degenerate[e] && face_of_edge_[e] != kNone && t_.face_solid[face_of_edge_[e]] != kNone &&
          !box_[e].is_empty())
        order.push_back(e);
    std::sort(order.begin(), order.end(),
              [&](EdgeId a, EdgeId b) { return box_[a].lo.x != box_[b].lo.x ? box_[a].lo.x < box_[b].lo.x : a < b; });
    return order;
  }

  /// What one face is to be compared with, as far as a pair of bodies may cost.
  void collect(FaceId f, const std::vector<EdgeId>& order) {
    if (t_.face_solid[f] == kNone) return;
    const std::set<VertexId> own = vertices_of(t_, f);
    const int cost = cost_of(t_.face_type[f]);
    for (const EdgeId e : order) {
      if (box_[e].lo.x > t_.face_box[f].hi.x) break;
      const std::pair<int, int> bodies = std::minmax(t_.face_solid[f], t_.face_solid[face_of_edge_[e]]);
      if (bodies.first == bodies.second || !meet(box_[e], t_.face_box[f])) continue;
      if (own.count(t_.edge_vertices[2 * e]) || own.count(t_.edge_vertices[2 * e + 1])) continue;
      Pair& pair = pairs_[bodies];
      if (pair.cost <= kMostCrossingTests) pair.tests.push_back({f, e});
      pair.cost += cost;
    }
  }

  /// Goes on with two bodies until they are known to cross, or have cost so much.
  void search(Pair& pair, int most) {
    while (!pair.found && pair.n_done < pair.tests.size() && pair.cost_done < most && cost_ < kMostCrossingTestsOfAll) {
      const Test test = pair.tests[pair.n_done++];
      const int cost = cost_of(t_.face_type[test.face]);
      if (!may_go_through(test.edge, test.face)) {
        pair.cost -= cost;
        continue;
      }
      pair.cost_done += cost;
      cost_ += cost;
      auto& intersector = intersectors_[test.face];
      if (!intersector)
        intersector =
            std::make_unique<IntCurvesFace_Intersector>(TopoDS::Face(model_.faces(test.face + 1)), tolerance_);
      if (const auto place = place_of(test.edge, *intersector))
        pair.found = BodyCrossing{face_of_edge_[test.edge], test.face, *place};
    }
  }

  bool may_go_through(EdgeId e, FaceId f) {
    if (t_.face_type[f] == SurfaceType::kPlane) return true;  // costs less than to look
    auto& [surface, grid] = surfaces_[f];
    const double* b = &t_.face_uv_bounds[4 * static_cast<std::size_t>(f)];
    if (!surface)
      surface = make_surface(BRep_Tool::Surface(TopoDS::Face(model_.faces(f + 1))), {{b[0], b[2]}, {b[1], b[3]}});
    return ThroughSearch(BRepAdaptor_Curve(TopoDS::Edge(edges_(e + 1))), *surface, grid, tolerance_).may_go_through();
  }

  CrossingBodies results() const {
    CrossingBodies result;
    for (const auto& [bodies, pair] : pairs_) {
      if (pair.found)
        result.found.push_back(*pair.found);
      else if (pair.cost_done < pair.cost)
        ++result.n_not_compared;
    }
    std::stable_sort(result.found.begin(), result.found.end(),
                     [](const BodyCrossing& a, const BodyCrossing& b) { return a.face < b.face; });
    return result;
  }

  /// Where the edge goes through the face, away from its ends and from the face's loops.
  std::optional<Vec3> place_of(EdgeId e, IntCurvesFace_Intersector& intersector) const {
    try {
      const Handle(BRepAdaptor_Curve) curve = new BRepAdaptor_Curve(TopoDS::Edge(edges_(e + 1)));
      const double t0 = curve->FirstParameter(), t1 = curve->LastParameter();
      if (curve->GetType() == GeomAbs_Line)
        intersector.Perform(curve->Line(), t0, t1);
      else
        intersector.Perform(curve, t0, t1);
      for (int k = 1; intersector.IsDone() && k <= intersector.NbPnt(); ++k) {
        const double w = intersector.WParameter(k), step = kStep * (t1 - t0);
        if (intersector.State(k) != TopAbs_IN || w < t0 + step || w > t1 - step) continue;
        const gp_Pnt p = intersector.Pnt(k);
        gp_Pnt on_face;
        gp_Vec du, dv;
        BRep_Tool::Surface(intersector.Face())
            ->D1(intersector.UParameter(k), intersector.VParameter(k), on_face, du, dv);
        const gp_Vec normal = du.Crossed(dv);
        if (normal.Magnitude() == 0) continue;
        const double before = gp_Vec(p, curve->Value(w - step)).Dot(normal) / normal.Magnitude(),
                     after = gp_Vec(p, curve->Value(w + step)).Dot(normal) / normal.Magnitude();
        if (before * after < 0 && std::min(std::abs(before), std::abs(after)) > kDeep * tolerance_) return vec(p);
      }
    } catch (const Standard_Failure&) {
    }
    return std::nullopt;
  }

  const ImportedShape& model_;
  const ModelTables& t_;
  const std::vector<Box3>& box_;
  double tolerance_;
  std::vector<FaceId> face_of_edge_;
  TopTools_IndexedMapOfShape edges_;
  std::map<std::pair<int, int>, Pair> pairs_;                             ///< of bodies, the smaller number first
  std::vector<std::unique_ptr<IntCurvesFace_Intersector>> intersectors_;  ///< [n_faces] null: not used yet
  std::vector<SampledSurface> surfaces_;                                  // [n_faces] likewise
  int cost_ = 0;
};

}  // namespace

CrossingBodies find_crossing_bodies(const ImportedShape& model, const ModelTables& tables,
                                    const FaceMeasures& measures) {
  if (tables.n_faces() < 2) return {};
  return CrossingSearch(model, tables, measures).find();
}

}  // namespace st::occt
