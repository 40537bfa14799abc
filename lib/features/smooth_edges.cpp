#include "features/smooth_edges.h"

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

}  // namespace st
