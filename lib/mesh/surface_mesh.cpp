#include "mesh/surface_mesh.h"

namespace st {
namespace {

bool is_closed(const MergedFeatures& m, std::size_t strip, const EdgeMesh& edges,
               const std::vector<VertexId>& edge_vertices) {
  const EdgeId kept = m.strip_kept[strip], closed = m.strip_closed[strip];
  const bool opposed = m.strip_is_opposed[strip];
  for (int k = 0; k < 2; ++k)
    if (edge_vertices[2 * kept + k] != edge_vertices[2 * closed + (opposed ? 1 - k : k)]) return false;
  const std::int32_t a = edges.first_node(kept), b = edges.first_node(closed), n = edges.n_nodes(kept);
  if (n < 2 || edges.n_nodes(closed) != n) return false;
  for (std::int32_t i = 1; i + 1 < n; ++i)
    if (!(edges.node_xyz[a + i] == edges.node_xyz[b + (opposed ? n - 1 - i : i)])) return false;
  return true;
}

}  // namespace

std::vector<FaceId> closed_faces(const MergedFeatures& merged, const EdgeMesh& edges,
                                 const std::vector<VertexId>& edge_vertices) {
  std::vector<FaceId> faces;
  for (std::size_t s = 0, end; s < merged.strip_face.size(); s = end) {
    bool is_all = true;  // around a ledge there are several
    for (end = s; end < merged.strip_face.size() && merged.strip_face[end] == merged.strip_face[s]; ++end)
      is_all = is_all && is_closed(merged, end, edges, edge_vertices);
    if (is_all) faces.push_back(merged.strip_face[s]);
  }
  return faces;
}

}  // namespace st
