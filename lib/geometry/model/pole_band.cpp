#include "geometry/model/pole_band.h"

#include <algorithm>

namespace st {

std::vector<std::uint8_t> edges_between_poles(const ModelTables& t) {
  std::vector<std::uint8_t> is_between(static_cast<std::size_t>(t.n_edges()), 0);
  std::vector<VertexId> poles;
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    poles.clear();
    for (const EdgeId e : t.edges_of(f))
      if (t.edge_is_degenerate[e]) poles.push_back(t.edge_vertices[2 * static_cast<std::size_t>(e)]);
    if (poles.size() < 2) continue;
    const auto is_pole = [&](VertexId v) { return std::ranges::find(poles, v) != poles.end(); };
    for (const EdgeId e : t.edges_of(f)) {
      const VertexId a = t.edge_vertices[2 * static_cast<std::size_t>(e)],
                     b = t.edge_vertices[2 * static_cast<std::size_t>(e) + 1];
      if (a != b && is_pole(a) && is_pole(b)) is_between[e] = 1;
    }
  }
  return is_between;
}

std::vector<Corners> fill_pole_band(const PoleChain& left, const PoleChain& right) {
  const auto &l = left.node, &r = right.node;
  std::vector<Corners> facets{{l[0], r[1], l[1]}};
  std::size_t i = 1, k = 1;
  while (i + 2 < l.size() || k + 2 < r.size()) {
    const bool goes_left = k + 2 == r.size() || (i + 2 < l.size() && left.at[i + 1] < right.at[k + 1]);
    const std::int32_t next = goes_left ? l[i + 1] : r[k + 1];
    facets.push_back({l[i], r[k], next});
    ++(goes_left ? i : k);
  }
  facets.push_back({l[i], r[k], l.back()});
  return facets;
}

}  // namespace st
