#include "geometry/import/crossing_faces.h"

#include <BRep_Tool.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <tuple>

#include "base/sort_once.h"
#include "base/threads.h"
#include "geometry/brep/face_domain.h"
#include "geometry/brep/occt_evaluators.h"
#include "geometry/model/cad_tolerance.h"
#include "geometry/model/edge_faces.h"
#include "geometry/model/sameness.h"
#include "geometry/shape/loop_polygons.h"
#include "geometry/shape/projection.h"
#include "geometry/shape/surface_crossing.h"

namespace st::occt {
namespace {

constexpr double kDeep = 10;           // times the tolerance: what counts as a crossing
constexpr int kStations = 32;          // along an edge, every eighth of them first
constexpr double kSideBySide = 0.7;    // cosine of the angle between walls that may come close
constexpr double kLeastSine = 0.02;    // of the angle of faces that pass through each other
constexpr double kFoldedBack = 0.996;  // cosine of the angle between faces that may lie on each other: 5 degrees
constexpr double kOn = 3;              // tolerances: how far apart faces are that do
constexpr int kMarch = 28;             // steps away from it,
constexpr double kReach = 0.95;        // of the range of u and v,
constexpr double kFirstStep = 2e-4;    // the first of them

bool is_formula(SurfaceType type) { return type < SurfaceType::kBezier || type == SurfaceType::kExtrusion; }

/// The way from a place of an edge into a face.
struct Section {
  Vec3 tangent;  ///< of the edge
  std::vector<Vec3> x;
  std::vector<Vec2> uv;
};

struct Place {
  Vec3 xyz;
  double size;  // extent of what is there, or how far it is from the common edge
};

Vec3 normal_of(const Handle(Geom_Surface) & surface, Vec2 uv) {
  gp_Pnt p;
  gp_Vec du, dv;
  surface->D1(uv.x, uv.y, p, du, dv);
  const gp_Vec n = du.Crossed(dv);
  return {n.X(), n.Y(), n.Z()};
}

/// Where an offset surface runs against its basis: the offset is larger than the radius there. The middle and extent of
/// what was found; nullopt for other surfaces.
template <class IsInside>
std::optional<Place> find_fold(const TopoDS_Face& face, const Box2& b, const IsInside& is_inside) {
  constexpr int kLines = 64;  // in u and in v
  Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  if (const auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface)) surface = trimmed->BasisSurface();
  const auto offset = Handle(Geom_OffsetSurface)::DownCast(surface);
  if (offset.IsNull()) return std::nullopt;
  Box3 folded;
  for (int i = 1; i < kLines; ++i)
    for (int j = 1; j < kLines; ++j) try {
        const Vec2 uv{b.lo.x + (b.hi.x - b.lo.x) * i / kLines, b.lo.y + (b.hi.y - b.lo.y) * j / kLines};
        if (dot(normal_of(offset, uv), normal_of(offset->BasisSurface(), uv)) < 0 && is_inside(uv))
          folded.add(vec(offset->Value(uv.x, uv.y)));
      } catch (const Standard_Failure&) {  // no normal at a singular point
      }
  if (folded.is_empty()) return std::nullopt;
  return Place{folded.center(), folded.diagonal()};
}

class CrossingFaces {
 public:
  CrossingFaces(const ImportedShape& model, const ModelTables& t)
      : model_(model), t_(t), tolerance_(kSamePlace * t.box().diagonal()), domains_(t.n_faces()) {}

  std::vector<FaceCrossing> find() {
    std::vector<std::optional<FaceCrossing>> within(domains_.size());
    parallel_for(within.size(), 1, [&](std::size_t i, std::size_t) {
      const auto f = static_cast<FaceId>(i);
      if (!is_formula(t_.face_type[f])) within[i] = find_within(f);
    });
    for (const std::optional<FaceCrossing>& crossing : within)
      if (crossing) found_.push_back(*crossing);
    const EdgeFaces faces_at(t_);
    TopExp::MapShapes(model_.shape, TopAbs_EDGE, edges_);
    std::vector<Border> borders;
    for (EdgeId e = 0; e < t_.n_edges(); ++e) {
      if (t_.edge_is_degenerate[e] || faces_at[e].size() != 2) continue;
      const FaceId f = faces_at[e][0], g = faces_at[e][1];
      if (f != g && !known_.contains(std::minmax(f, g))) borders.push_back({e, f, g, false, {}});
    }
    look_at_all(borders);
    for (const Border& b : borders) {
      if (known_.contains(std::minmax(b.f, b.g))) continue;
      if (b.turns_back) look_for_overlap(b.e, b.f, b.g);
      if (!b.crossing || !known_.insert(std::minmax(b.f, b.g)).second) continue;
      found_.push_back({std::min(b.f, b.g), std::max(b.f, b.g), false, false, b.crossing->xyz, b.crossing->size});
    }
    return found_;
  }

 private:
  struct Domain {
    FaceDomain face;
    LoopPolygons loops;
  };

  /// An edge between two faces.
  struct Border {
    EdgeId e;
    FaceId f, g;
    bool turns_back;                // both faces go the same way from most of it
    std::optional<Place> crossing;  // of the faces, beside it
  };

  /// A face serves one thread at a time.
  void look_at_all(std::vector<Border>& borders) {
    std::vector<FaceId> used;
    for (const Border& b : borders) used.insert(used.end(), {b.f, b.g});
    sort_once(used);
    parallel_for(used.size(), 1, [&](std::size_t i, std::size_t) { domain(used[i]); });
    std::vector<std::mutex> in_use(domains_.size());
    parallel_for(borders.size(), 1, [&](std::size_t i, std::size_t) {
      Border& b = borders[i];
      const std::scoped_lock lock(in_use[b.f], in_use[b.g]);
      b.turns_back = turn_back(b.e, b.f, b.g);
      if (!is_formula(t_.face_type[b.f]) || !is_formula(t_.face_type[b.g])) b.crossing = look_beside(b.e, b.f, b.g);
    });
  }

  const Domain& domain(FaceId f) {
    if (!domains_[f]) {
      Domain d{make_domain(TopoDS::Face(model_.faces(f + 1).Oriented(TopAbs_FORWARD))), {}};
      std::vector<LoopSide> sides;
      for (const LoopUv& loop : d.face.loops) {
        const std::vector<Vec2> p = loop.polygon();
        for (std::size_t k = 0; k < p.size(); ++k) sides.push_back({p[k], p[(k + 1) % p.size()]});
      }
      d.loops = LoopPolygons(std::move(sides));
      domains_[f] = std::make_unique<Domain>(std::move(d));
    }
    return *domains_[f];
  }

  double tolerance_of(FaceId f) const { return kDeep * std::max(tolerance_, cad_tolerance(t_, f)); }

  /// Faces beside each other at the same time: it makes domain(f), and looks at no other.
  std::optional<FaceCrossing> find_within(FaceId f) {
    const Domain& d = domain(f);
    const auto is_inside = [&](Vec2 uv) { return d.loops.contains(uv); };
    if (const auto fold = find_fold(TopoDS::Face(model_.faces(f + 1)), d.face.bounds, is_inside))
      return FaceCrossing{f, f, false, true, fold->xyz, fold->size};
    if (const auto p = find_self_crossing(*d.face.surface, tolerance_of(f), is_inside)) {
      const double size = distance(d.face.surface->point(0.5 * (p->uv_a + p->uv_b)), p->x);
      return FaceCrossing{f, f, false, false, p->x, size};
    }
    const auto pinch = find_pinch(*d.face.surface, tolerance_of(f), is_inside);
    return pinch ? std::optional<FaceCrossing>({f, f, true, false, *pinch, 0}) : std::nullopt;
  }

  /// Everywhere along the edge where both faces turn the same way beside it.
  std::optional<Place> look_beside(EdgeId e, FaceId f, FaceId g) {
    bool is_near = false;
    for (int k = 4; k < kStations && !is_near; k += 8) {
      const double station = static_cast<double>(k) / kStations;
      is_near = run_side_by_side(section(f, e, station), section(g, e, station));
    }
    for (int k = 1; is_near && k < kStations; ++k) {
      const double station = static_cast<double>(k) / kStations;
      if (const auto place = crossing_of(section(f, e, station), f, section(g, e, station), g)) return place;
    }
    return std::nullopt;
  }

  /// Into the face, square to the edge, at a share of the edge; zero where there is no way.
  Vec3 inward(FaceId f, EdgeId e, double station) {
    const Section way = inner_section(f, e, station);
    if (way.x.size() < 2) return {};
    const Vec3 step = way.x[1] - way.x[0];
    return normalized(step - dot(step, way.tangent) * way.tangent);
  }

  /// Both faces go the same way from most of the edge.
  bool turn_back(EdgeId e, FaceId f, FaceId g) {
    int n = 0;
    for (const double station : {0.25, 0.5, 0.75}) n += dot(inward(f, e, station), inward(g, e, station)) > kFoldedBack;
    return n >= 2;
  }

  void look_for_overlap(EdgeId e, FaceId f, FaceId g) {
    for (const auto& [a, b] : {std::pair{f, g}, std::pair{g, f}}) {
      int n_on = 0;
      FaceCrossing found;
      std::tie(found.first, found.second) = std::minmax(f, g);
      found.is_overlap = true;
      for (int k = 2; k < kStations; k += 4) {
        const auto place = place_on(inner_section(a, e, static_cast<double>(k) / kStations), a, b);
        if (!place) continue;
        ++n_on;
        if (place->size > found.size) found.size = place->size, found.xyz = place->xyz;
      }
      if (n_on < kStations / 8) continue;
      known_.insert({found.first, found.second});
      found_.push_back(found);
      return;
    }
  }

  /// Half the way across the one face, where that is on the other one and clearly away from the edge.
  std::optional<Place> place_on(const Section& way, FaceId a, FaceId b) {
    std::size_t n = 0;  // steps inside
    while (n < way.uv.size() && (n == 0 || domain(a).loops.contains(way.uv[n]))) ++n;
    if (n < 3) return std::nullopt;
    const double across = distance(way.x[0], way.x[n - 1]), tolerance = tolerance_of(a) / kDeep;
    std::size_t middle = 1;
    while (middle + 1 < n && distance(way.x[0], way.x[middle]) < 0.5 * across) ++middle;
    const Vec3 x = way.x[middle];
    const double depth = distance(way.x[0], x), near = std::max(tolerance, tolerance_of(b) / kDeep);
    if (depth < kDeep * near) return std::nullopt;
    const auto foot = closest_point(*domain(b).face.surface, x);
    if (foot.distance > kOn * near || !domain(b).loops.contains(foot.uv)) return std::nullopt;
    return Place{x, depth};
  }

  static bool run_side_by_side(const Section& a, const Section& b) {
    for (std::size_t i = 1; i < std::min(a.x.size(), b.x.size()); ++i)
      if (dot(normalized(a.x[i] - a.x[i - 1]), normalized(b.x[i] - b.x[i - 1])) > kSideBySide) return true;
    return false;
  }

  Section section(FaceId f, EdgeId e, double station) {
    const FaceDomain& d = domain(f).face;
    for (const LoopUv& loop : d.loops)
      for (const CoedgeUv& c : loop.coedges) {
        if (c.curve.IsNull() || loop.is_turned || !c.edge.IsSame(edges_(e + 1))) continue;
        const double lo = std::min(c.t_start, c.t_end), hi = std::max(c.t_start, c.t_end);
        gp_Pnt2d p;
        gp_Vec2d along;
        c.curve->D1(lo + station * (hi - lo), p, along);
        if (c.t_end < c.t_start) along.Reverse();
        return march(*d.surface, {p.X(), p.Y()}, {along.X(), along.Y()});
      }
    return {};
  }

  /// The same where the loop may run the other way: the section whose first step is inside the face.
  Section inner_section(FaceId f, EdgeId e, double station) {
    const Section left = section(f, e, station);
    if (left.uv.empty() || (left.uv.size() > 1 && domain(f).loops.contains(left.uv[1]))) return left;
    const SurfacePoint at = domain(f).face.surface->evaluate(left.uv[0]);
    const double uu = norm2(at.du), uv = dot(at.du, at.dv), vv = norm2(at.dv), du = dot(left.tangent, at.du),
                 dv = dot(left.tangent, at.dv);
    return march(*domain(f).face.surface, left.uv[0], {uv * dv - vv * du, uv * du - uu * dv});  // against the tangent
  }

  /// To the left of `along` in (u,v): lengths there do not tell, at noses they change from step to step.
  static Section march(const Surface& surface, Vec2 start, Vec2 along) {
    const double range_u = surface.u_max() - surface.u_min(), range_v = surface.v_max() - surface.v_min();
    Vec2 left{-along.y / range_v, along.x / range_u};
    if (!(norm(left) > 0)) return {};
    left = left * (1 / norm(left));
    const SurfacePoint at = surface.evaluate(start);
    Section s{normalized(along.x * at.du + along.y * at.dv), {at.x}, {start}};
    const double growth = std::pow(kReach / kFirstStep, 1.0 / kMarch);
    for (double way = kFirstStep; way < kReach; way *= growth) {
      const Vec2 uv = start + Vec2{way * left.x * range_u, way * left.y * range_v};
      if (uv.x < surface.u_min() || uv.x > surface.u_max() || uv.y < surface.v_min() || uv.y > surface.v_max()) break;
      s.x.push_back(surface.point(uv));
      s.uv.push_back(uv);
    }
    return s;
  }

  /// Where two sections cross, confirmed on the surfaces.
  std::optional<Place> crossing_of(const Section& a, FaceId f, const Section& b, FaceId g) {
    if (a.x.size() < 3 || b.x.size() < 3) return std::nullopt;
    const Vec3 e1 = normalized(cross(a.tangent, std::abs(a.tangent.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0})),
               e2 = cross(a.tangent, e1);
    const auto flat = [&](const Section& s) {
      std::vector<Vec2> places;
      for (const Vec3 x : s.x) places.push_back({dot(x - a.x[0], e1), dot(x - a.x[0], e2)});
      return places;
    };
    const std::vector<Vec2> flat_a = flat(a), flat_b = flat(b);
    for (std::size_t i = 0; i + 1 < a.x.size(); ++i)
      for (std::size_t k = 0; k + 1 < b.x.size(); ++k) {
        if (i == 0 && k == 0) continue;
        if (!cross_properly({flat_a[i], flat_a[i + 1]}, {flat_b[k], flat_b[k + 1]})) continue;
        if (const auto place = confirmed(f, 0.5 * (a.uv[i] + a.uv[i + 1]), g, 0.5 * (b.uv[k] + b.uv[k + 1])))
          return place;
      }
    return std::nullopt;
  }

  std::optional<Place> confirmed(FaceId f, Vec2 uv_f, FaceId g, Vec2 uv_g) {
    const Domain &a = domain(f), &b = domain(g);
    const auto p = common_point(*a.face.surface, uv_f, *b.face.surface, uv_g, 1e-3 * tolerance_);
    if (!p || !a.loops.contains(p->uv_a) || !b.loops.contains(p->uv_b)) return std::nullopt;
    const double size = distance_from_common(f, g, p->x);
    const double exact = kDeep * std::max(cad_tolerance(t_, f), cad_tolerance(t_, g));
    if (size < kDeep * tolerance_ || p->sine < kLeastSine || p->sine * size < exact) return std::nullopt;
    return Place{p->x, size};
  }

  double distance_from_common(FaceId f, FaceId g, Vec3 x) const {
    const auto of_f = t_.edges_of(f), of_g = t_.edges_of(g);
    double least = std::numeric_limits<double>::max();
    for (const EdgeId e : of_f) {
      if (t_.edge_is_degenerate[e] || std::find(of_g.begin(), of_g.end(), e) == of_g.end()) continue;
      double t0, t1;
      const Handle(Geom_Curve) curve = BRep_Tool::Curve(TopoDS::Edge(edges_(e + 1)), t0, t1);
      if (!curve.IsNull()) least = std::min(least, closest_point(*make_curve(curve, t0, t1), x).distance);
    }
    return least;
  }

  const ImportedShape& model_;
  const ModelTables& t_;
  double tolerance_;
  std::vector<std::unique_ptr<Domain>> domains_;
  TopTools_IndexedMapOfShape edges_;
  std::set<std::pair<FaceId, FaceId>> known_;
  std::vector<FaceCrossing> found_;
};

}  // namespace

std::vector<FaceCrossing> find_crossing_faces(const ImportedShape& model, const ModelTables& tables) {
  try {
    return CrossingFaces(model, tables).find();
  } catch (const Standard_Failure&) {
    return {};
  }
}

}  // namespace st::occt
