#include "meshing/engine/mesh_result.h"

#include "base/threads.h"

namespace st {
namespace {

void renew(const SizeField& field, const std::vector<Vec3>& xyz, const std::vector<NodeId>& previous,
           std::vector<double>& size) {
  constexpr std::size_t kPerPiece = 16'384;
  parallel_for(xyz.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
    int hint = 0;
    for (std::size_t i = begin; i < end; ++i)
      if (previous.empty() || previous[i] == kNone) size[i] = field.size(xyz[i], hint);
  });
}

}  // namespace

void store_requests(const SizeField& field, MeshResult& r) {
  if (r.edges.node_request.empty()) r.edges.node_request = r.edges.node_size;
  renew(field, r.edges.node_xyz, r.edges.node_previous, r.edges.node_request);
  if (r.edges.node_request == r.edges.node_size) r.edges.node_request.clear();
  parallel_for(r.patches.size(), 1, [&](std::size_t i, std::size_t) {
    FacePatch& p = r.patches[i];
    renew(field, p.inner_xyz, p.inner_previous, p.inner_size);
  });
}

}  // namespace st
