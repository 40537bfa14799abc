#include "meshing/engine/mesh_result.h"

namespace st {

void store_requests(const SizeField& field, MeshResult& r) {
  int hint = 0;
  const auto renew = [&](const std::vector<Vec3>& xyz, const std::vector<NodeId>& previous, std::vector<double>& size) {
    for (std::size_t i = 0; i < xyz.size(); ++i)
      if (previous.empty() || previous[i] == kNone) size[i] = field.size(xyz[i], hint);
  };
  if (r.edges.node_request.empty()) r.edges.node_request = r.edges.node_size;
  renew(r.edges.node_xyz, r.edges.node_previous, r.edges.node_request);
  if (r.edges.node_request == r.edges.node_size) r.edges.node_request.clear();
  for (FacePatch& p : r.patches) renew(p.inner_xyz, p.inner_previous, p.inner_size);
}

}  // namespace st
