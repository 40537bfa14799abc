#include "features/unlisted_wings.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "base/disjoint_sets.h"
#include "base/eigen.h"
#include "features/profile.h"

namespace st {
namespace {

constexpr int kPlaces = 9;             // on an edge
constexpr double kSail = 0.15;         // thickness of a sheet's border over its width
constexpr double kFlat = 1e-3;         // thickness of a plane loop over its width
constexpr double kInPlane = 0.9;       // cosine: the surface lies in the plane of its border
constexpr double kDeflection = 1e-3;   // of a face's diagonal: of its facets
constexpr double kLeastLength = 0.05;  // of the reference diagonal: of a seam

Vec3 place_on(const Curve& curve, int i) {
  return curve.point(curve.t_min() + (curve.t_max() - curve.t_min()) * (i + 0.5) / kPlaces);
}

/// Used once, by a wall.
std::vector<EdgeId> free_edges(const ModelTables& t, const FaceRoles& roles) {
  std::vector<std::int32_t> offsets;
  std::vector<FaceId> faces;
  t.edge_faces(offsets, faces);
  std::vector<EdgeId> free;
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    if (!t.edge_is_degenerate[e] && offsets[e + 1] - offsets[e] == 1 &&
        roles.role[faces[static_cast<std::size_t>(offsets[e])]] == FaceRole::kWall)
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

/// About as flat as a sail; and not plane with a surface that comes through, as at the open end of a body.
bool bounds_sheet(const Model& model, const std::vector<EdgeId>& loop) {
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
  for (const EdgeId e : loop)
    for (const Vec3 n : normals_at(model, e))
      if (std::abs(dot(n, shape.axis[0])) > kInPlane) return true;
  return false;
}

/// The plane square to an edge half way cuts a profile with round ends out of the faces.
bool is_blade(const Model& model, std::span<const FaceId> faces, EdgeId seam) {
  const ModelTables& t = model.tables();
  std::vector<std::uint8_t> is_wanted(static_cast<std::size_t>(t.n_faces()), 0);
  double diagonal = 0;
  for (const FaceId f : faces) {
    is_wanted[f] = 1;
    diagonal = std::max(diagonal, t.face_box[f].diagonal());
  }
  const double deflection = kDeflection * diagonal;
  const Facets facets = make_facets(model, is_wanted, {.deflection = deflection, .is_exact = true});
  const ProfileCutter cutter(facets);
  const auto curve = model.curve(seam);
  const CurvePoint p = curve->evaluate(0.5 * (curve->t_min() + curve->t_max()));
  const Vec3 normal = normalized(p.d1);
  const std::optional<Vec3> end = cutter.furthest(p.x, normal, 2 * deflection);
  if (!end) return false;
  const std::optional<Vec3> other = cutter.furthest(*end, normal, 2 * deflection);
  return other && (cutter.cut(*end, normal, 2 * deflection) || cutter.cut(*other, normal, 2 * deflection));
}

}  // namespace

std::vector<EdgeId> find_sheet_edges(const Model& model, const FaceRoles& roles) {
  std::vector<EdgeId> found;
  for (const std::vector<EdgeId>& loop : loops_of(model.tables(), free_edges(model.tables(), roles)))
    if (bounds_sheet(model, loop)) found.insert(found.end(), loop.begin(), loop.end());
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<EdgeId> find_seams_of_blades(const Model& model, const FaceRoles& roles,
                                         std::span<const LiftingSurface> wings) {
  const ModelTables& t = model.tables();
  std::vector<std::int32_t> offsets;
  std::vector<FaceId> edge_faces;
  t.edge_faces(offsets, edge_faces);
  const auto is_free = [&](FaceId f) {
    const auto has_face = [&](const LiftingSurface& wing) { return std::ranges::count(wing.faces, f) > 0; };
    return roles.role[f] == FaceRole::kWall && t.face_type[f] == SurfaceType::kBspline &&
           std::ranges::none_of(wings, has_face);
  };
  std::vector<std::uint8_t> is_done(static_cast<std::size_t>(t.n_faces()), 0);
  std::vector<EdgeId> found;
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    if (t.edge_is_degenerate[e] || t.edge_length[e] < kLeastLength * roles.reference_diagonal) continue;
    const auto at =
        std::span(edge_faces)
            .subspan(static_cast<std::size_t>(offsets[e]), static_cast<std::size_t>(offsets[e + 1] - offsets[e]));
    if (at.size() != 2 || is_done[at[0]] || !is_free(at[0]) || !is_free(at[1])) continue;
    const auto is_shared = [&](EdgeId own) { return std::ranges::count(t.edges_of(at[1]), own) > 0; };
    if (at[0] != at[1] && std::ranges::count_if(t.edges_of(at[0]), is_shared) < 2) continue;
    if (!is_blade(model, at, e)) continue;
    found.push_back(e);
    is_done[at[0]] = is_done[at[1]] = 1;
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace st
