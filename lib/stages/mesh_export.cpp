#include "stages/mesh_export.h"

#include <fmt/format.h>

#include <filesystem>

#include "base/error.h"
#include "base/log.h"
#include "io/export/vtu_writer.h"
#include "io/file/text_file.h"
#include "mesh/group_mesh.h"
#include "mesh/quality.h"

namespace st {

void export_and_warn(const std::string& path, const ExportMesh& mesh, const ExportOptions& options) {
  const std::vector<std::string> lost = export_mesh(path, mesh, options);
  if (!lost.empty()) log_warning(fmt::format("{}: this format has no room for {}", path, fmt::join(lost, ", ")));
}

std::vector<TriangleValues> measured_values(const SurfaceMesh& mesh) {
  TriangleValues quality{"quality", {}}, ratio{"size_ratio", {}};
  for (const Triangle& t : mesh.triangles) {
    const auto [a, b, c] = t.n;
    const Vec3 x = mesh.node_xyz[a], y = mesh.node_xyz[b], z = mesh.node_xyz[c];
    quality.of_triangle.push_back(static_cast<float>(triangle_quality(x, y, z)));
    const double wanted = mesh.node_size[a] + mesh.node_size[b] + mesh.node_size[c];
    ratio.of_triangle.push_back(static_cast<float>((distance(x, y) + distance(y, z) + distance(z, x)) / wanted));
  }
  return {quality, ratio};
}

std::vector<GroupFile> export_groups(const std::string& path, const SurfaceMesh& mesh,
                                     std::span<const TriangleValues> values, const ExportOptions& options) {
  const std::vector<std::string> words = group_words(mesh);
  const std::vector<std::vector<TriangleId>> of_group = triangles_by_group(mesh);
  std::vector<GroupFile> files;
  for (std::size_t g = 0; g < of_group.size(); ++g) {
    if (of_group[g].empty()) continue;
    const SurfaceMesh part = mesh_of_triangles(mesh, of_group[g]);
    const QuadPairs elements = options.has_quads ? pair_triangles(part) : all_triangles(part);
    std::vector<TriangleValues> of_part;
    for (const TriangleValues& v : values) {
      of_part.push_back({v.name, {}});
      for (const TriangleId t : of_group[g]) of_part.back().of_triangle.push_back(v.of_triangle[t]);
    }
    files.push_back({mesh.labels.group_name[g], path_of_group(path, words[g])});
    export_mesh(files.back().path, {part, elements, {}, of_part}, options);
  }
  return files;
}

void export_blocks(const std::string& path, const SurfaceMesh& mesh, std::span<const TriangleValues> values,
                   const ExportOptions& options) {
  const std::filesystem::path target(path), folder = target.parent_path() / target.stem();
  std::error_code failure;
  const bool is_new = std::filesystem::create_directories(folder, failure);
  if (failure)
    throw Error(ExitCode::kOutput, fmt::format("{}: cannot be made ({})", folder.string(), failure.message()));
  const std::string block = (folder / target.stem()).string() + ".vtu";
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\" "
      "byte_order=\"LittleEndian\">\n<vtkMultiBlockDataSet>\n";
  int index = 0;
  try {
    for (const auto& [group, file] : export_groups(block, mesh, values, options)) {
      const std::filesystem::path name(file);
      text += fmt::format("<DataSet index=\"{}\" name=\"{}\" file=\"{}\"/>\n", index++, xml_escaped(group),
                          xml_escaped((folder.filename() / name.filename()).string()));
    }
    write_text_file(path, text + "</vtkMultiBlockDataSet>\n</VTKFile>\n");
  } catch (...) {
    if (is_new) std::filesystem::remove_all(folder, failure);
    throw;
  }
}

}  // namespace st
