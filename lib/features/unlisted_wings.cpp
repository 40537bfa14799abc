#include "features/unlisted_wings.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "base/box_tree.h"
#include "base/disjoint_sets.h"
#include "base/eigen.h"
#include "features/profile.h"
#include "geometry/model/edge_faces.h"

namespace st {
namespace {

constexpr int kPlaces = 9;             // on an edge
constexpr double kSail = 0.15;         // thickness of a sheet's border over its width
constexpr double kFlat = 1e-3;         // thickness of a plane loop over its width
constexpr double kInPlane = 0.9;       // cosine: the surface lies in the plane of its border
constexpr double kDeflection = 1e-3;   // of a face's diagonal: of its facets
constexpr double kLeastLength = 0.05;  // of the reference diagonal: of a seam
constexpr double kGap = 0.03;          // of a plane loop's box: to other free edges, where faces were not sewn
constexpr double kCoarse = 5;          // of the deflection: of facets that show that a cut is round
constexpr double kClear = 20;          // deflections: a shorter cut is not seen on coarse facets
constexpr double kFull = 0.6;          // thickness half way between the ends of a cut over that way: a circle has 1

Vec3 place_on(const Curve& curve, int i) {
  return curve.point(curve.t_min() + (curve.t_max() - curve.t_min()) * (i + 0.5) / kPlaces);
}

/// Used once, by a wall.
std::vector<EdgeId> free_edges(const ModelTables& t, const FaceRoles& roles) {
  const EdgeFaces faces_at(t);
  std::vector<EdgeId> free;
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    if (!t.edge_is_degenerate[e] && faces_at[e].size() == 1 && roles.role[faces_at[e][0]] == FaceRole::kWall)
      free.push_back(e);
  return free;
}

/// Edges that hang together at vertices.
std::vector<std::vector<EdgeId>> loops_of(const ModelTables& t, const std::vector<EdgeId>& edges) {
  DisjointSets vertices(t.n_vertices());
  for (const EdgeId e : edges) vertices.join(t.edge_vertices[2 * e], t.edge_vertices[2 * e + 1]);
  std::map<std::int32_t, std::vector<EdgeId>> loops;
  for (const EdgeId e : edges) loops[vertices.find(t.edge_vertices[2 * e])].push_back(e);
  std::vector<std::vector<EdgeId>> all;
  for (auto& [key, own] : loops) all.push_back(std::move(own));
  return all;
}

/// Normals of the faces at a free edge.
std::vector<Vec3> normals_at(const Model& model, EdgeId e) {
  const ModelTables& t = model.tables();
  std::vector<Vec3> normals;
  for (FaceId f = 0; f < t.n_faces(); ++f)
    for (const CoedgeId c : t.coedges(f)) {
      if (t.coedge_edge[c] != e) continue;
      const auto pcurve = model.pcurve(f, c);
      const double t0 = t.edge_range[2 * e], t1 = t.edge_range[2 * e + 1];
      for (int i = 0; i < kPlaces; ++i)
        normals.push_back(surface_normal(*model.surface(f), pcurve->point(t0 + (t1 - t0) * (i + 0.5) / kPlaces)));
    }
  return normals;
}

/// Free edges of all loops, to see which run beside others.
class FreeEdges {
 public:
  FreeEdges(const Model& model, const std::vector<std::vector<EdgeId>>& loops) {
    std::vector<Box3> boxes;
    for (std::size_t l = 0; l < loops.size(); ++l)
      for (const EdgeId e : loops[l]) {
        const auto curve = model.curve(e);
        Vec3 last = curve->point(curve->t_min());
        for (int i = 1; i <= kPlaces; ++i) {
          const Vec3 x = curve->point(curve->t_min() + (curve->t_max() - curve->t_min()) * i / kPlaces);
          pieces_.push_back({last, x, l});
          boxes.emplace_back();
          boxes.back().add(last);
          boxes.back().add(x);
          last = x;
        }
      }
    tree_ = BoxTree(boxes);
  }

  /// Whether edges of other loops run beside most of a loop.
  bool run_beside(std::size_t loop, std::span<const Vec3> places) const {
    Box3 box;
    for (const Vec3 x : places) box.add(x);
    const double gap = kGap * box.diagonal();
    const auto is_beside = [&](Vec3 x) {
      bool is_near = false;
      tree_.visit_near(
          x, [&](std::int32_t, double d2) { return !is_near && d2 <= gap * gap; },
          [&](std::int32_t i) {
            const Piece& piece = pieces_[static_cast<std::size_t>(i)];
            is_near = is_near || (piece.loop != loop && segment_distance(x, piece.begin, piece.end) <= gap);
          });
      return is_near;
    };
    return 2 * std::ranges::count_if(places, is_beside) > static_cast<std::ptrdiff_t>(places.size());
  }

 private:
  struct Piece {
    Vec3 begin, end;
    std::size_t loop;
  };
  std::vector<Piece> pieces_;
  BoxTree tree_;
};

/// About as flat as a sail; and not plane with a surface that comes through, as at the open end of a body,
/// nor one of a body's faces that were not sewn.
bool bounds_sheet(const Model& model, const std::vector<std::vector<EdgeId>>& loops, std::size_t own,
                  const FreeEdges& free) {
  const std::vector<EdgeId>& loop = loops[own];
  std::vector<Vec3> x;
  for (const EdgeId e : loop)
    for (int i = 0; i < kPlaces; ++i) x.push_back(place_on(*model.curve(e), i));
  Vec3 middle;
  for (const Vec3 p : x) middle += p / static_cast<double>(x.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vec3 p : x) spread += to_eigen(p - middle) * to_eigen(p - middle).transpose();
  const PrincipalAxes shape = principal_axes(spread);
  const auto extent = [&](int k) { return std::sqrt(std::max(0.0, shape.value[k])); };
  if (extent(0) > kSail * extent(1)) return false;
  if (extent(0) > kFlat * extent(2)) return true;
  if (free.run_beside(own, x)) return false;
  for (const EdgeId e : loop)
    for (const Vec3 n : normals_at(model, e))
      if (std::abs(dot(n, shape.axis[0])) > kInPlane) return true;
  return false;
}

/// Cuts of pairs of faces by the plane square to an edge half way. Facets are kept: some pairs have many such edges.
class BladeTester {
 public:
  explicit BladeTester(const Model& model) : model_(model) {}

  /// Whether it is a profile with round ends.
  bool is_blade(std::span<const FaceId> faces, EdgeId seam) {
    const auto curve = model_.curve(seam);
    const CurvePoint p = curve->evaluate(0.5 * (curve->t_min() + curve->t_max()));
    const Vec3 normal = normalized(p.d1);
    double diagonal = 0;
    for (const FaceId f : faces) diagonal = std::max(diagonal, model_.tables().face_box[f].diagonal());
    const double deflection = kDeflection * diagonal;
    Pair& pair = pairs_[{std::min(faces[0], faces[1]), std::max(faces[0], faces[1])}];
    if (!pair.coarse) pair.coarse = facets_of(faces, {.deflection = kCoarse * deflection});
    if (is_round(*pair.coarse, p.x, normal, kCoarse * deflection)) return false;
    if (!pair.exact) pair.exact = facets_of(faces, {.deflection = deflection, .is_exact = true});
    const ProfileCutter cutter(*pair.exact);
    return cutter.round_profile(p.x, normal, 2 * deflection).has_value();
  }

 private:
  struct Pair {
    std::optional<Facets> coarse, exact;
  };

  Facets facets_of(std::span<const FaceId> faces, const FacetLimits& limits) const {
    std::vector<std::uint8_t> is_wanted(static_cast<std::size_t>(model_.tables().n_faces()), 0);
    for (const FaceId f : faces) is_wanted[f] = 1;
    return make_facets(model_, is_wanted, limits);
  }

  /// As a pipe is. Only where coarse facets show it clearly.
  static bool is_round(const Facets& facets, Vec3 x, Vec3 normal, double deflection) {
    const std::optional<ThinPart> whole = ProfileCutter(facets).whole(x, normal, 2 * deflection);
    return whole && whole->chord > kClear * deflection && whole->middle > kFull * whole->chord;
  }

  const Model& model_;
  std::map<std::pair<FaceId, FaceId>, Pair> pairs_;
};

}  // namespace

std::vector<EdgeId> find_sheet_edges(const Model& model, const FaceRoles& roles) {
  std::vector<EdgeId> found;
  const std::vector<std::vector<EdgeId>> loops = loops_of(model.tables(), free_edges(model.tables(), roles));
  const FreeEdges free(model, loops);
  for (std::size_t l = 0; l < loops.size(); ++l)
    if (bounds_sheet(model, loops, l, free)) found.insert(found.end(), loops[l].begin(), loops[l].end());
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<EdgeId> find_seams_of_blades(const Model& model, const FaceRoles& roles,
                                         std::span<const LiftingSurface> wings) {
  const ModelTables& t = model.tables();
  const EdgeFaces faces_at(t);
  const auto is_free = [&](FaceId f) {
    const auto has_face = [&](const LiftingSurface& wing) { return std::ranges::count(wing.faces, f) > 0; };
    return roles.role[f] == FaceRole::kWall && t.face_type[f] == SurfaceType::kBspline &&
           std::ranges::none_of(wings, has_face);
  };
  BladeTester tester(model);
  std::vector<std::uint8_t> is_done(static_cast<std::size_t>(t.n_faces()), 0);
  std::vector<EdgeId> found;
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    if (t.edge_is_degenerate[e] || t.edge_length[e] < kLeastLength * roles.reference_diagonal) continue;
    const auto at = faces_at[e];
    if (at.size() != 2 || is_done[at[0]] || !is_free(at[0]) || !is_free(at[1])) continue;
    const auto is_shared = [&](EdgeId own) { return std::ranges::count(t.edges_of(at[1]), own) > 0; };
    if (at[0] != at[1] && std::ranges::count_if(t.edges_of(at[0]), is_shared) < 2) continue;
    if (!tester.is_blade(at, e)) continue;
    found.push_back(e);
    is_done[at[0]] = is_done[at[1]] = 1;
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace st
