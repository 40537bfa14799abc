#include "features/smooth_edges.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace st {
namespace {

constexpr int kPlaces = 9;
constexpr double kSmooth = radians(3);  // between the normals on both sides

/// Outer normals at places on one edge, for each of its coedges.
struct EdgeNormals {
  int n_uses = 0;
  std::array<std::array<Vec3, kPlaces>, 2> normal;

  bool is_smooth() const {
    if (n_uses != 2) return false;
    for (int i = 0; i < kPlaces; ++i)
      if (!(norm2(normal[0][i]) > 0 && norm2(normal[1][i]) > 0 && angle_between(normal[0][i], normal[1][i]) <= kSmooth))
        return false;
    return true;
  }
};

}  // namespace

std::vector<std::uint8_t> find_smooth_edges(const Model& model) {
  const ModelTables& t = model.tables();
  std::vector<EdgeNormals> edges(static_cast<std::size_t>(t.n_edges()));
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    const auto surface = model.surface(f);
    for (const LoopId l : t.loops(f))
      for (const CoedgeId c : t.loop_coedges(l)) {
        const EdgeId e = t.coedge_edge[c];
        EdgeNormals& own = edges[e];
        const int use = own.n_uses++;
        if (use > 1 || t.edge_is_degenerate[e]) continue;
        const auto pcurve = model.pcurve(f, c);
        const double t0 = t.edge_range[2 * e], t1 = t.edge_range[2 * e + 1];
        for (int i = 0; i < kPlaces; ++i) {
          const Vec3 n = surface_normal(*surface, pcurve->point(t0 + (t1 - t0) * (i + 0.5) / kPlaces));
          own.normal[use][i] = t.face_is_reversed[f] ? -n : n;
        }
      }
  }
  std::vector<std::uint8_t> is_smooth;
  for (EdgeId e = 0; e < t.n_edges(); ++e) is_smooth.push_back(!t.edge_is_degenerate[e] && edges[e].is_smooth());
  return is_smooth;
}

bool is_smooth_half_way(const Model& model, EdgeId e, std::span<const FaceId> faces, double most) {
  const ModelTables& t = model.tables();
  const double middle = 0.5 * (t.edge_range[2 * e] + t.edge_range[2 * e + 1]);
  std::vector<Vec3> normals;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const FaceId f = faces[k];
    if (std::ranges::count(faces.first(k), f) > 0) continue;  // a seam
    for (const CoedgeId c : t.coedges(f)) {
      if (t.coedge_edge[c] != e) continue;
      const Vec3 n = surface_normal(*model.surface(f), model.pcurve(f, c)->point(middle));
      normals.push_back(t.face_is_reversed[f] ? -n : n);
    }
  }
  return normals.size() == 2 && angle_between(normals[0], normals[1]) <= most;
}

}  // namespace st
