#include "io/export/metric_export.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "io/export/medit_writer.h"

namespace st {
namespace {

template <std::size_t N>
void write_cells(MeditWriter& file, const MeditKeyword& keyword,
                 const std::vector<std::array<std::int32_t, N>>& cells) {
  file.begin({keyword, static_cast<std::int64_t>(cells.size()), N + 1});
  for (const auto& cell : cells) {
    MeditEntry e;
    for (const std::int32_t n : cell) e.integers.push_back(n + 1);
    e.integers.push_back(1);
    file.entry(e);
  }
}

void write_mesh(MeditWriter& file, const BackgroundMesh& mesh) {
  file.begin({kMeditVertices, static_cast<std::int64_t>(mesh.node_xyz.size()), 1, 3});
  for (const Vec3& p : mesh.node_xyz) file.entry({{0}, {p.x, p.y, p.z}}, true);
  if (mesh.tets.empty())
    write_cells(file, kMeditTriangles, mesh.triangles);
  else
    write_cells(file, kMeditTetrahedra, mesh.tets);
  file.end();
}

bool is_isotropic(const std::array<double, 6>& m) {
  constexpr double kRounding = 1e-12;
  const double least = kRounding * m[0];
  return std::max({std::abs(m[1] - m[0]), std::abs(m[2] - m[0]), std::abs(m[3]), std::abs(m[4]), std::abs(m[5])}) <=
         least;
}

void write_metric(MeditWriter& file, std::span<const std::array<double, 6>> metric) {
  constexpr std::int32_t kScalar = 1, kSymmetric = 3;
  const bool is_scalar = std::all_of(metric.begin(), metric.end(), is_isotropic);
  file.begin({kMeditSolution, static_cast<std::int64_t>(metric.size()), 0, is_scalar ? 1 : 6,
              is_scalar ? kScalar : kSymmetric});
  for (const auto& [xx, yy, zz, xy, yz, xz] : metric)
    if (is_scalar)
      file.entry({{}, {1 / std::sqrt(xx)}});
    else
      file.entry({{}, {xx, xy, yy, xz, yz, zz}});  // Medit's order
  file.end();
}

}  // namespace

std::array<std::string, 2> metric_files(const std::string& path) {
  std::filesystem::path mesh(path);
  const std::string suffix = mesh.extension().string();
  if (suffix != ".sol" && suffix != ".solb")
    throw Error(ExitCode::kUsage, path + ": sizes are written as .solb, or as text as .sol; end the name so");
  return {mesh.replace_extension(suffix == ".sol" ? ".mesh" : ".meshb").string(), path};
}

void export_metric(const std::string& path, const BackgroundMesh& mesh, std::span<const std::array<double, 6>> metric) {
  const auto [mesh_path, solution_path] = metric_files(path);
  const bool is_binary = std::filesystem::path(path).extension() == ".solb";
  Output mesh_file(mesh_path), solution_file(solution_path);
  MeditWriter mesh_writer(mesh_file, is_binary), solution_writer(solution_file, is_binary);
  write_mesh(mesh_writer, mesh);
  write_metric(solution_writer, metric);
  mesh_file.commit();
  solution_file.commit();
}

}  // namespace st
