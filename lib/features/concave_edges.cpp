#include "features/concave_edges.h"

#include <algorithm>
#include <array>
#include <span>

#include "base/threads.h"

namespace st {
namespace {

constexpr int kPlaces = 5;                // along each edge
constexpr double kConcave = radians(30);  // beyond flat: where a body stands on another one
constexpr double kFading = radians(10);   // likewise where it runs out between two such edges, both longer

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

/// Beyond flat, where it is most so.
double concave_angle(const EdgeSide& a, const EdgeSide& b) {
  double most = 0;
  for (int i = 0; i < kPlaces; ++i)
    if (dot(b.inward[i], a.normal[i]) > 0) most = std::max(most, kPi - angle_between(a.inward[i], b.inward[i]));
  return most;
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

/// Marks the edges along which a body fades out, as the tail of a pylon does. A body all around which stands clearly on
/// another one would else be one with it, by that piece.
void add_fading(const ModelTables& t, std::span<const double> angle, std::vector<std::uint8_t>& is_concave) {
  std::vector<double> longest(t.vertex_xyz.size(), 0);  // of the clearly concave edges at each vertex, model unit
  const auto ends = [&](std::size_t e) { return std::span(t.edge_vertices).subspan(2 * e, 2); };
  for (std::size_t e = 0; e < is_concave.size(); ++e)
    if (is_concave[e])
      for (const VertexId v : ends(e)) longest[v] = std::max(longest[v], t.edge_length[e]);
  for (std::size_t e = 0; e < is_concave.size(); ++e)
    if (angle[e] >= kFading && std::ranges::all_of(ends(e), [&](VertexId v) { return longest[v] > t.edge_length[e]; }))
      is_concave[e] = 1;
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
  std::vector<double> angle;
  std::vector<std::uint8_t> is_concave;
  for (const std::vector<CoedgeId>& own : of_edge) {
    angle.push_back(own.size() == 2 ? concave_angle(side[own[0]], side[own[1]]) : 0);
    is_concave.push_back(angle.back() >= kConcave);
  }
  add_fading(t, angle, is_concave);
  return is_concave;
}

}  // namespace st
