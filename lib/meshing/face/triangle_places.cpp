#include "meshing/face/triangle_places.h"

#include <map>
#include <utility>

#include "base/disjoint_sets.h"
#include "mesh/adjacency.h"

namespace st {
namespace {

/// Empty where the triangles are no disc.
std::vector<NodeId> loop_around(std::span<const Triangle> triangles, const std::vector<std::size_t>& place) {
  std::map<std::pair<NodeId, NodeId>, int> sides;
  for (const std::size_t t : place)
    for (int k = 0; k < 3; ++k) ++sides[{triangles[t].n[k], triangles[t].n[(k + 1) % 3]}];
  std::map<NodeId, NodeId> next;
  for (const auto& [side, count] : sides) {
    if (sides.contains({side.second, side.first})) continue;
    if (count > 1 || !next.emplace(side).second) return {};
  }
  std::vector<NodeId> loop;
  if (next.empty()) return loop;
  for (NodeId n = next.begin()->first; loop.empty() || n != loop.front(); n = next.at(n)) {
    loop.push_back(n);
    if (!next.contains(next.at(n)) || loop.size() > next.size()) return {};
  }
  return loop.size() == next.size() ? loop : std::vector<NodeId>();
}

}  // namespace

std::vector<TrianglePlace> places_about(std::span<const Triangle> triangles, std::int64_t n_nodes,
                                        std::span<const std::size_t> seeds, int rings) {
  const std::size_t n = triangles.size();
  std::vector<std::uint8_t> is_in(n, 0), is_near(static_cast<std::size_t>(n_nodes), 0);
  for (const std::size_t t : seeds) is_in[t] = 1;
  for (int ring = 0; ring < rings; ++ring) {
    for (std::size_t t = 0; t < n; ++t)
      for (int k = 0; is_in[t] && k < 3; ++k) is_near[triangles[t].n[k]] = 1;
    for (std::size_t t = 0; t < n; ++t)
      for (int k = 0; k < 3; ++k) is_in[t] |= is_near[triangles[t].n[k]];
  }
  DisjointSets sets(n_nodes);
  for (std::size_t t = 0; t < n; ++t)
    for (int k = 1; is_in[t] && k < 3; ++k) sets.join(triangles[t].n[0], triangles[t].n[k]);
  std::map<std::int32_t, TrianglePlace> by_set;
  for (std::size_t t = 0; t < n; ++t)
    if (is_in[t]) by_set[sets.find(triangles[t].n[0])].triangles.push_back(t);
  for (const std::size_t t : seeds) ++by_set[sets.find(triangles[t].n[0])].n_seeds;
  std::vector<TrianglePlace> result;
  for (auto& [set, place] : by_set) {
    place.loop = loop_around(triangles, place.triangles);
    result.push_back(std::move(place));
  }
  return result;
}

}  // namespace st
