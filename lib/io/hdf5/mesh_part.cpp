#include "io/hdf5/mesh_part.h"

#include <numeric>
#include <utility>

#include "io/hdf5/mesh_file.h"

namespace st {

MeshPart read_mesh_part(const std::string& path, int part, int n_parts) {
  const MeshFile file(path);
  const std::int64_t begin = file.n_triangles() * part / n_parts, n = file.n_triangles() * (part + 1) / n_parts - begin;
  std::vector<TriangleId> triangles(static_cast<std::size_t>(n));
  std::iota(triangles.begin(), triangles.end(), static_cast<TriangleId>(begin));
  MeshSelection selection = file.select(std::move(triangles), MeshFile::Rows::kAllWithEdgeNodes);
  MeshPart result{file.head(), static_cast<TriangleId>(begin), std::move(selection.node_number)};
  result.artifact.mesh = std::move(selection.mesh);
  if (file.has_cad_faces()) result.artifact.triangle_cad_face = file.cad_faces(begin, n);
  return result;
}

}  // namespace st
