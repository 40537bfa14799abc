#include "judge/edge_angles.h"

#include <algorithm>
#include <array>

#include "geometry/shape/surface.h"

namespace st {

EdgeAngles::EdgeAngles(const Model& model)
    : model_(model),
      uses_(static_cast<std::size_t>(model.tables().n_edges())),
      largest_(static_cast<std::size_t>(model.tables().n_edges()), -1) {
  const ModelTables& t = model.tables();
  for (FaceId f = 0; f < t.n_faces(); ++f)
    for (const CoedgeId c : t.coedges(f)) uses_[t.coedge_edge[c]].push_back({f, c});
}

double EdgeAngles::largest_deg(EdgeId e) {
  double& known = largest_[e];
  if (known < 0) known = measure(e);
  return known;
}

double EdgeAngles::measure(EdgeId e) const {
  constexpr int kPlaces = 9;
  constexpr double kUnknown = 180;
  const ModelTables& t = model_.tables();
  if (uses_[e].size() != 2 || t.edge_is_degenerate[e]) return kUnknown;
  std::array<std::array<Vec3, kPlaces>, 2> normals;
  for (std::size_t side = 0; side < 2; ++side) {
    const auto [face, coedge] = uses_[e][side];
    const auto surface = model_.surface(face);
    const auto pcurve = model_.pcurve(face, coedge);
    for (int i = 0; i < kPlaces; ++i) {
      const double share = (i + 0.5) / kPlaces,
                   at = (1 - share) * t.edge_range[2 * e] + share * t.edge_range[2 * e + 1];
      const Vec3 n = surface_normal(*surface, pcurve->point(at));
      normals[side][i] = t.face_is_reversed[face] != 0 ? -n : n;
    }
  }
  double largest = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const Vec3 a = normals[0][i], b = normals[1][i];
    if (!(norm2(a) > 0 && norm2(b) > 0)) return kUnknown;
    largest = std::max(largest, degrees(angle_between(a, b)));
  }
  return largest;
}

}  // namespace st
