#include "stages/mesh_export.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

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

std::vector<GroupFile> group_files(const std::string& path, const SurfaceMesh& mesh) {
  const std::vector<std::string> words = group_words(mesh);
  std::vector<std::vector<TriangleId>> of_group = triangles_by_group(mesh);
  std::vector<GroupFile> files;
  for (std::size_t g = 0; g < of_group.size(); ++g)
    if (!of_group[g].empty())
      files.push_back({mesh.labels.group_name[g], path_of_group(path, words[g]), std::move(of_group[g])});
  return files;
}

std::string block_path(const std::string& path) {
  const std::filesystem::path target(path);
  return (target.parent_path() / target.stem() / target.stem()).string() + ".vtu";
}

namespace {

/// Of the nodes of these triangles, in the order that mesh_of_triangles() gives them.
std::vector<NodeValues> values_on(const ExportMesh& mesh, std::span<const TriangleId> triangles) {
  std::vector<NodeValues> of_part;
  if (mesh.node_values.empty()) return of_part;
  std::vector<char> is_used(mesh.mesh.node_xyz.size(), 0);
  for (const TriangleId t : triangles)
    for (const NodeId n : mesh.mesh.triangles[t].n) is_used[n] = 1;
  for (const NodeValues& v : mesh.node_values) {
    NodeValues& part = of_part.emplace_back(NodeValues{v.name, v.n_components, {}});
    for (std::size_t i = 0; i < v.values.size(); ++i)
      if (is_used[i / v.n_components]) part.values.push_back(v.values[i]);
  }
  return of_part;
}

}  // namespace

std::vector<GroupFile> export_groups(const std::string& path, const ExportMesh& mesh, const ExportOptions& options) {
  std::vector<GroupFile> files = group_files(path, mesh.mesh);
  for (const GroupFile& file : files) {
    const SurfaceMesh part = mesh_of_triangles(mesh.mesh, file.triangles);
    const QuadPairs elements = options.has_quads ? pair_triangles(part) : all_triangles(part);
    std::vector<TriangleValues> of_part;
    for (const TriangleValues& v : mesh.values) {
      of_part.push_back({v.name, {}});
      for (const TriangleId t : file.triangles) of_part.back().of_triangle.push_back(v.of_triangle[t]);
    }
    export_mesh(file.path, {part, elements, {}, of_part, values_on(mesh, file.triangles)}, options);
  }
  return files;
}

void export_blocks(const std::string& path, const ExportMesh& mesh, const ExportOptions& options) {
  const std::string block = block_path(path);
  const std::filesystem::path folder = std::filesystem::path(block).parent_path();
  std::error_code failure;
  const bool is_new = std::filesystem::create_directories(folder, failure);
  if (failure)
    throw Error(ExitCode::kOutput, fmt::format("{}: cannot be made ({})", folder.string(), failure.message()));
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\" "
      "byte_order=\"LittleEndian\">\n<vtkMultiBlockDataSet>\n";
  int index = 0;
  try {
    for (const GroupFile& file : export_groups(block, mesh, options)) {
      const std::filesystem::path name(file.path);
      text += fmt::format("<DataSet index=\"{}\" name=\"{}\" file=\"{}\"/>\n", index++, xml_escaped(file.group),
                          xml_escaped((folder.filename() / name.filename()).string()));
    }
    write_text_file(path, text + "</vtkMultiBlockDataSet>\n</VTKFile>\n");
  } catch (...) {
    if (is_new) std::filesystem::remove_all(folder, failure);
    throw;
  }
}

}  // namespace st
