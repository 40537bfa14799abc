#include "stages/mesh_export.h"

#include <fmt/format.h>

#include "base/log.h"
#include "mesh/group_mesh.h"

namespace st {

void export_and_warn(const std::string& path, const ExportMesh& mesh, const ExportOptions& options) {
  const std::vector<std::string> lost = export_mesh(path, mesh, options);
  if (!lost.empty()) log_warning(fmt::format("{}: this format has no room for {}", path, fmt::join(lost, ", ")));
}

std::size_t export_groups(const std::string& path, const SurfaceMesh& mesh, const ExportOptions& options) {
  const std::vector<std::string> words = group_words(mesh);
  const std::vector<std::vector<TriangleId>> of_group = triangles_by_group(mesh);
  std::size_t n_files = 0;
  for (std::size_t g = 0; g < of_group.size(); ++g) {
    if (of_group[g].empty()) continue;
    const SurfaceMesh part = mesh_of_triangles(mesh, of_group[g]);
    const QuadPairs elements = options.has_quads ? pair_triangles(part) : all_triangles(part);
    export_mesh(path_of_group(path, words[g]), {part, elements, {}}, options);
    ++n_files;
  }
  return n_files;
}

}  // namespace st
