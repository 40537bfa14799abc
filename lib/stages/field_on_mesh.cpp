#include "stages/field_on_mesh.h"

#include "base/threads.h"
#include "mesh/node_normals.h"

namespace st {

RequestedLength lengths_along(const SizeField& field) {
  if (!field.has_metrics()) return {};
  return [&field](Vec3 x, Vec3 way, int& hint) { return field.length_along(x, way, hint); };
}

std::vector<Vec3> squeeze_of_nodes(const SurfaceMesh& mesh, const SizeField* field) {
  if (!field || !field->is_stretched()) return {};
  constexpr std::size_t kPerPiece = 16'384;
  std::vector<Vec3> squeeze(mesh.node_xyz.size());
  std::vector<Vec3> normal;  // of no use without metrics
  if (field->has_metrics()) normal = node_normals(mesh.node_xyz, mesh.triangles);
  parallel_for(squeeze.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
    int hint = 0;
    for (std::size_t n = begin; n < end; ++n)
      squeeze[n] = field->local_on(mesh.node_xyz[n], normal.empty() ? Vec3{} : normal[n], hint).squeeze();
  });
  return squeeze;
}

}  // namespace st
