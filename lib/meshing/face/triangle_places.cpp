#include "meshing/face/triangle_places.h"

#include <algorithm>
#include <map>
#include <utility>

#include "base/disjoint_sets.h"
#include "mesh/adjacency.h"

namespace st {
namespace {

/// Empty where the triangles are no disc.
std::vector<NodeId> loop_around(std::span<const Triangle> triangles, const std::vector<std::size_t>& place) {
  using Side = std::pair<NodeId, NodeId>;
  std::vector<Side> sides, next;  // ascending; next: of the rim
  for (const std::size_t t : place)
    for (int k = 0; k < 3; ++k) sides.push_back({triangles[t].n[k], triangles[t].n[(k + 1) % 3]});
  std::ranges::sort(sides);
  for (const Side& side : sides) {
    if (std::ranges::binary_search(sides, Side{side.second, side.first})) continue;
    if (!next.empty() && next.back().first == side.first) return {};
    next.push_back(side);
  }
  std::vector<NodeId> loop;
  if (next.empty()) return loop;
  for (auto at = next.begin(); loop.empty() || at->first != loop.front();) {
    loop.push_back(at->first);
    const NodeId to = at->second;
    at = std::ranges::lower_bound(next, to, {}, &Side::first);
    if (at == next.end() || at->first != to || loop.size() > next.size()) return {};
  }
  return loop.size() == next.size() ? loop : std::vector<NodeId>();
}

}  // namespace

std::vector<TrianglePlace> places_about(std::span<const Triangle> triangles, std::int64_t n_nodes,
                                        std::span<const std::size_t> seeds, int rings) {
  const std::size_t n = triangles.size();
  std::vector<std::uint8_t> is_in(n, 0), near(static_cast<std::size_t>(n_nodes), 0);  // near: since this ring
  const auto add = [&](std::size_t t, int ring) {
    is_in[t] = 1;
    for (const NodeId node : triangles[t].n)
      if (!near[node]) near[node] = static_cast<std::uint8_t>(ring);
  };
  const auto is_reached = [&](NodeId node, int ring) { return near[node] && near[node] <= ring; };
  for (const std::size_t t : seeds) add(t, 1);
  for (int ring = 1; ring <= rings; ++ring)
    for (std::size_t t = 0; t < n; ++t)
      if (const NodeId* v = triangles[t].n;
          !is_in[t] && (is_reached(v[0], ring) || is_reached(v[1], ring) || is_reached(v[2], ring)))
        add(t, ring + 1);
  std::vector<std::size_t> all;
  for (std::size_t t = 0; t < n; ++t)
    if (is_in[t]) all.push_back(t);
  DisjointSets sets(n_nodes);
  for (const std::size_t t : all)
    for (int k = 1; k < 3; ++k) sets.join(triangles[t].n[0], triangles[t].n[k]);
  std::map<std::int32_t, TrianglePlace> by_set;
  for (const std::size_t t : all) by_set[sets.find(triangles[t].n[0])].triangles.push_back(t);
  for (const std::size_t t : seeds) ++by_set[sets.find(triangles[t].n[0])].n_seeds;
  std::vector<TrianglePlace> result;
  for (auto& [set, place] : by_set) {
    place.loop = loop_around(triangles, place.triangles);
    result.push_back(std::move(place));
  }
  return result;
}

}  // namespace st
