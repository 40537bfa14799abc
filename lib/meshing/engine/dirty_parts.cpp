#include "meshing/engine/dirty_parts.h"

namespace st {

DirtyParts find_dirty_parts(const MeshTopology& topology, const EdgeMesh& edges,
                            std::span<const Refinement> refinements,
                            std::span<const std::pair<EdgeId, EdgeId>> followers) {
  const ModelTables& t = topology.tables();
  DirtyParts dirty{std::vector<char>(t.n_edges(), 0), std::vector<char>(t.n_faces(), 0)};
  for (const Refinement& r : refinements) {
    for (EdgeId e = 0; e < t.n_edges(); ++e)
      for (std::int32_t i = edges.first_node(e); !dirty.edge[e] && i < edges.first_node(e) + edges.n_nodes(e); ++i)
        dirty.edge[e] = distance(edges.node_xyz[i], r.x) < r.reach + edges.node_size[i];
    for (FaceId f = 0; f < t.n_faces(); ++f) dirty.face[f] |= box_distance(t.face_box[f], r.x) < r.reach;
  }
  for (const MeshTopology::Strip& s : topology.strips())
    dirty.edge[s.closed] = dirty.edge[s.kept] |= dirty.edge[s.closed];
  for (const auto& [edge, leader] : followers) dirty.edge[leader] |= dirty.edge[edge];
  for (const auto& [edge, leader] : followers) dirty.edge[edge] |= dirty.edge[leader];
  for (FaceId f = 0; f < t.n_faces(); ++f)
    for (const EdgeId e : t.edges_of(f)) dirty.face[f] |= dirty.edge[e];
  return dirty;
}

}  // namespace st
