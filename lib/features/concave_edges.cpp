#include "features/concave_edges.h"

#include <array>

#include "base/threads.h"

namespace st {
namespace {

constexpr int kPlaces = 5;                // along each edge
constexpr double kConcave = radians(30);  // beyond flat: where a body stands on another one

struct EdgePlaces {
  std::array<double, kPlaces> t;
  std::array<Vec3, kPlaces> tangent;  // unit
};

EdgePlaces places_on(const Curve& curve) {
  EdgePlaces places;
  for (int i = 0; i < kPlaces; ++i) {
    places.t[i] = curve.t_min() + (curve.t_max() - curve.t_min()) * (i + 0.5) / kPlaces;
    places.tangent[i] = normalized(curve.evaluate(places.t[i]).d1);
  }
  return places;
}

/// One side of an edge at its places.
struct EdgeSide {
  std::array<Vec3, kPlaces> normal, inward;  // unit: out of the solid; along the face, away from the edge
};

bool is_concave(const EdgeSide& a, const EdgeSide& b) {
  for (int i = 0; i < kPlaces; ++i)
    if (dot(b.inward[i], a.normal[i]) > 0 && angle_between(a.inward[i], b.inward[i]) <= kPi - kConcave) return true;
  return false;
}

/// Of all coedges of a face, its normals turned round where `is_turned`.
void find_sides(const Model& model, FaceId f, bool is_turned, std::vector<EdgeSide>& side) {
  const ModelTables& t = model.tables();
  const auto surface = model.surface(f);
  for (const CoedgeId c : t.coedges(f)) {
    if (t.edge_is_degenerate[t.coedge_edge[c]]) continue;
    const EdgePlaces places = places_on(*model.curve(t.coedge_edge[c]));
    const auto pcurve = model.pcurve(f, c);
    for (int i = 0; i < kPlaces; ++i) {
      const Vec3 n = surface_normal(*surface, pcurve->point(places.t[i])), tangent = places.tangent[i];
      side[c].normal[i] = is_turned ? -n : n;
      side[c].inward[i] = normalized(cross(n, t.coedge_is_reversed[c] ? -tangent : tangent));
    }
  }
}

}  // namespace

std::vector<std::uint8_t> find_concave_edges(const Model& model, const FaceRoles& roles) {
  constexpr std::size_t kFacesPerPiece = 4;
  const ModelTables& t = model.tables();
  const bool is_turned = is_material_ahead(t, roles);
  std::vector<EdgeSide> side(static_cast<std::size_t>(t.n_coedges()));
  parallel_for(static_cast<std::size_t>(t.n_faces()), kFacesPerPiece, [&](std::size_t begin, std::size_t end) {
    for (auto f = static_cast<FaceId>(begin); f < static_cast<FaceId>(end); ++f)
      if (roles.role[f] == FaceRole::kWall) find_sides(model, f, (t.face_is_reversed[f] != 0) != is_turned, side);
  });
  std::vector<std::vector<CoedgeId>> of_edge(static_cast<std::size_t>(t.n_edges()));
  for (FaceId f = 0; f < t.n_faces(); ++f)
    if (roles.role[f] == FaceRole::kWall)
      for (const CoedgeId c : t.coedges(f))
        if (!t.edge_is_degenerate[t.coedge_edge[c]]) of_edge[t.coedge_edge[c]].push_back(c);
  std::vector<std::uint8_t> is_concave_edge;
  for (const std::vector<CoedgeId>& own : of_edge)
    is_concave_edge.push_back(own.size() == 2 && is_concave(side[own[0]], side[own[1]]));
  return is_concave_edge;
}

}  // namespace st
