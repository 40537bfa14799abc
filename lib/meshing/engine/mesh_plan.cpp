#include "meshing/engine/mesh_plan.h"
#include "geometry/model/edge_faces.h"

#include <utility>

namespace st {

MeshPlan plan_all(const MeshTopology& topology) {
  std::vector<FaceId> faces;
  for (FaceId f = 0; f < topology.tables().n_faces(); ++f)
    if (!topology.tables().is_joined(f)) faces.push_back(f);
  MeshPlan plan{{}, std::move(faces), EdgeMesh::of_edges(topology.tables().n_edges()), {}, {}};
  for (EdgeId e = 0; e < topology.tables().n_edges(); ++e)
    if (!topology.tables().edge_is_degenerate[e]) plan.edges.push_back(e);
  return plan;
}

MeshPlan plan_part(const MeshTopology& topology, std::vector<FaceId> faces, EdgeMesh fixed) {
  const ModelTables& t = topology.tables();
  if (fixed.edge_offsets.empty()) fixed = EdgeMesh::of_edges(t.n_edges());
  std::vector<char> used(t.n_edges(), 0);
  for (const FaceId f : faces)
    for (const EdgeId e : t.edges_of(f)) used[e] = 1;
  for (const MeshTopology::Strip& strip : topology.strips())
    if (used[strip.closed]) used[strip.kept] = 1;
  MeshPlan plan{{}, std::move(faces), std::move(fixed), {}, {}};
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    if (used[e] && !t.edge_is_degenerate[e] && plan.kept_edges.n_nodes(e) == 0) plan.edges.push_back(e);
  return plan;
}

MeshPlan plan_again(const MeshTopology& topology, std::vector<FaceId> faces, EdgeMesh edges,
                    std::vector<FacePatch> patches, const std::vector<char>& keep_edge) {
  const ModelTables& t = topology.tables();
  std::vector<char> again(t.n_faces(), 0);
  for (const FaceId f : faces) again[f] = 1;
  const EdgeFaces faces_at(t);
  MeshPlan plan{{}, std::move(faces), std::move(edges), std::move(patches), {}};
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    bool all = !t.edge_is_degenerate[e] && !faces_at[e].empty() && (keep_edge.empty() || !keep_edge[e]);
    for (const FaceId f : faces_at[e]) all = all && again[f];
    if (all) plan.edges.push_back(e);
  }
  return plan;
}

}  // namespace st
