#include "meshing/engine/dirty_parts.h"

#include <algorithm>
#include <iterator>

#include "base/threads.h"

namespace st {
namespace {

/// Whether a refinement reaches a node of the edge, or the length there.
bool is_reached(const EdgeMesh& edges, EdgeId e, std::span<const Refinement> refinements) {
  const std::int32_t begin = edges.first_node(e), end = begin + edges.n_nodes(e);
  Box3 box;
  double longest = 0;
  for (std::int32_t i = begin; i < end; ++i) {
    box.add(edges.node_xyz[i]);
    longest = std::max(longest, edges.node_size[i]);
  }
  for (const Refinement& r : refinements) {
    if (begin == end || box_distance(box, r.x) > r.reach + longest) continue;
    for (std::int32_t i = begin; i < end; ++i)
      if (distance(edges.node_xyz[i], r.x) < r.reach + edges.node_size[i]) return true;
  }
  return false;
}

}  // namespace

DirtyParts find_dirty_parts(const MeshTopology& topology, const EdgeMesh& edges,
                            std::span<const Refinement> refinements,
                            std::span<const std::pair<EdgeId, EdgeId>> followers) {
  const ModelTables& t = topology.tables();
  DirtyParts dirty{std::vector<char>(t.n_edges(), 0), std::vector<char>(t.n_faces(), 0)};
  constexpr std::size_t kPerPiece = 64;
  parallel_for(dirty.edge.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) dirty.edge[e] = is_reached(edges, static_cast<EdgeId>(e), refinements);
  });
  parallel_for(dirty.face.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f)
      dirty.face[f] = std::ranges::any_of(
          refinements, [&](const Refinement& r) { return box_distance(t.face_box[f], r.x) < r.reach; });
  });
  for (const MeshTopology::Strip& s : topology.strips())
    dirty.edge[s.closed] = dirty.edge[s.kept] |= dirty.edge[s.closed];
  for (const auto& [edge, leader] : followers) dirty.edge[leader] |= dirty.edge[edge];
  for (const auto& [edge, leader] : followers) dirty.edge[edge] |= dirty.edge[leader];
  for (FaceId f = 0; f < t.n_faces(); ++f)
    for (const EdgeId e : t.edges_of(f)) dirty.face[f] |= dirty.edge[e];
  return dirty;
}

std::vector<std::int32_t> chosen_of(const std::vector<std::int32_t>& ids, const std::vector<char>& is_chosen) {
  std::vector<std::int32_t> chosen;
  std::copy_if(ids.begin(), ids.end(), std::back_inserter(chosen), [&](std::int32_t i) { return is_chosen[i] != 0; });
  return chosen;
}

}  // namespace st
