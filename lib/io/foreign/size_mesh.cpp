#include "io/foreign/size_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>

#include "base/error.h"
#include "io/file/text_file.h"
#include "io/foreign/cell_file.h"

namespace st {
namespace {

namespace fs = std::filesystem;

bool has_suffix(const std::string& path, std::initializer_list<const char*> suffixes) {
  const std::string own = fs::path(path).extension().string();
  return std::find(suffixes.begin(), suffixes.end(), own) != suffixes.end();
}
bool is_medit_mesh(const std::string& path) { return has_suffix(path, {".mesh", ".meshb"}); }
bool is_msh(const std::string& path) { return has_suffix(path, {".msh", ".msh2"}); }
bool is_medit_solution(const std::string& path) { return has_suffix(path, {".sol", ".solb"}); }

/// What FILE, FILE:ARRAY, MESH:SOLUTION and MESH:SOLUTION:ARRAY name.
struct FileName {
  std::string path, array, solution;  ///< of a mesh of Medit whose solution has another name
};

FileName parse_name(const std::string& file) {
  const std::size_t colon = file.rfind(':');
  if (colon == std::string::npos || fs::exists(file)) return {file, "", ""};
  const std::string before = file.substr(0, colon), after = file.substr(colon + 1);
  if (is_medit_mesh(before) && is_medit_solution(after)) return {before, "", after};
  const std::size_t first = before.rfind(':');
  if (first == std::string::npos || fs::exists(before) || !is_medit_mesh(before.substr(0, first)))
    return {before, after, ""};
  return {before.substr(0, first), after, before.substr(first + 1)};
}

/// Number of a field of Medit, from 1; 0: none is named.
std::int64_t field_number(const FileName& name) {
  std::int64_t number = 0;
  if (name.array.empty()) return number;
  const char* const end = name.array.data() + name.array.size();
  const auto [stop, error] = std::from_chars(name.array.data(), end, number);
  if (error != std::errc() || stop != end || number < 1)
    throw Error(ExitCode::kInput, fmt::format("{}: fields of Medit have numbers from 1; '{}' is none",
                                              name.solution.empty() ? name.path : name.solution, name.array));
  return number;
}

/// The file of the same name with one of these suffixes.
std::string beside(const std::string& path, std::initializer_list<const char*> suffixes, const char* what) {
  for (const char* suffix : suffixes)
    if (const fs::path other = fs::path(path).replace_extension(suffix); fs::is_regular_file(other))
      return other.string();
  throw Error(ExitCode::kInput,
              fmt::format("{}: has no {} beside it: {}; one of another name is given as MESH:SOLUTION", path, what,
                          fs::path(path).replace_extension(*suffixes.begin()).string()));
}

CellFile read_medit(const std::vector<std::string>& mesh_and_solution, std::int64_t number) {
  const std::string &mesh = mesh_and_solution[0], &solution = mesh_and_solution[1];
  CellFile file = parse_medit_mesh(mesh, MappedBytes(mesh).bytes());
  parse_medit_solution(solution, MappedBytes(solution).bytes(), number, file);
  return file;
}

/// Cells as simplices whose nodes exist. `group`: of each, where cells have some.
void split_cells(const std::string& path, const CellFile& file, BackgroundMesh& mesh,
                 std::vector<std::int32_t>& group) {
  const auto n_nodes = static_cast<std::int64_t>(file.node_xyz.size());
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> of_triangle;
  for (std::size_t c = 0; c < file.type.size(); ++c) {
    const int n = n_corners_of(file.type[c]);
    if (n == 0) continue;
    if (n < 0)
      throw Error(ExitCode::kInput, fmt::format("{}: cell {} is of VTK's type {}, which is not read; cut cells into "
                                                "tetrahedra (ParaView: Tetrahedralize)",
                                                path, c, file.type[c]));
    std::array<std::int32_t, 8> corner{};
    for (int k = 0; k < n; ++k) {
      const std::int64_t at = file.offset[c] + k, node = at < file.offset[c + 1] ? file.node[at] : -1;
      if (node < 0 || node >= n_nodes)
        throw Error(ExitCode::kInput, fmt::format("{}: cell {} names a node that does not exist", path, c));
      corner[k] = static_cast<std::int32_t>(node);
    }
    if (is_volume(file.type[c]))
      split_volume(file.type[c], corner.data(), mesh.tets);
    else
      split_surface(file.type[c], corner.data(), triangles);
    if (file.group.empty()) continue;
    group.resize(mesh.tets.size(), file.group[c]);
    of_triangle.resize(triangles.size(), file.group[c]);
  }
  if (mesh.tets.empty()) {
    mesh.triangles = std::move(triangles);
    group = std::move(of_triangle);
  }
  if (mesh.is_empty()) throw Error(ExitCode::kInput, path + ": has neither tetrahedra nor triangles");
}

/// Values at cells as their mean at the nodes of these; those of a node without a cell are 0.
void average_cells(const std::string& path, CellFile& file) {
  const std::size_t n_cells = file.type.size(), n_nodes = file.node_xyz.size(),
                    n_components = file.cell_value.size() / std::max<std::size_t>(n_cells, 1);
  if (n_components * n_cells != file.cell_value.size())
    throw Error(ExitCode::kInput, fmt::format("{}: has {} values for {} cells", path, file.cell_value.size(), n_cells));
  file.value.assign(n_components * n_nodes, 0);
  std::vector<double> n_cells_at(n_nodes, 0);
  for (std::size_t c = 0; c < n_cells; ++c)
    for (std::int64_t at = file.offset[c]; n_corners_of(file.type[c]) > 2 && at < file.offset[c + 1]; ++at) {
      const auto node = static_cast<std::size_t>(file.node[at]);
      n_cells_at[node] += 1;
      for (std::size_t k = 0; k < n_components; ++k)
        file.value[node * n_components + k] += file.cell_value[c * n_components + k];
    }
  for (std::size_t i = 0; i < file.value.size(); ++i)
    if (const double n = n_cells_at[i / n_components]; n > 1) file.value[i] /= n;
}

/// Of one node; length 0: neither a positive length nor a positive definite metric.
void add_size(const double* v, std::size_t n_components, BackgroundMesh& mesh) {
  if (n_components == 1) {
    mesh.node_size.push_back(v[0] > 0 && std::isfinite(v[0]) ? LocalSize{v[0], v[0], {}} : LocalSize{});
    return;
  }
  if (n_components == 6)
    mesh.node_metric.push_back({v[0], v[1], v[2], v[3], v[4], v[5]});
  else
    mesh.node_metric.push_back({v[0], v[4], v[8], 0.5 * (v[1] + v[3]), 0.5 * (v[5] + v[7]), 0.5 * (v[2] + v[6])});
  mesh.node_size.push_back(size_of_metric(mesh.node_metric.back()));
}

void read_sizes(const std::string& path, const CellFile& file, BackgroundMesh& mesh) {
  const std::size_t n_nodes = file.node_xyz.size(),
                    n_components = file.value.size() / std::max<std::size_t>(n_nodes, 1);
  if (n_components * n_nodes != file.value.size() || (n_components != 1 && n_components != 6 && n_components != 9))
    throw Error(ExitCode::kInput,
                fmt::format("{}: has {} values for {} nodes; one length each, or a metric of 6 or 9 components is "
                            "expected",
                            path, file.value.size(), n_nodes));
  std::vector<char> is_used(n_nodes, 0);
  for (const auto& tet : mesh.tets)
    for (const std::int32_t n : tet) is_used[n] = 1;
  for (const auto& triangle : mesh.triangles)
    for (const std::int32_t n : triangle) is_used[n] = 1;
  std::size_t n_bad = 0, first = 0;
  for (std::size_t i = 0; i < n_nodes; ++i) {
    add_size(file.value.data() + i * n_components, n_components, mesh);
    if (!is_used[i] || mesh.node_size[i].length > 0) continue;
    if (n_bad++ == 0) first = i;
  }
  if (n_bad == 0) return;
  const Vec3 x = file.node_xyz[first];
  throw Error(
      ExitCode::kInput,
      fmt::format("{}: {} of {} nodes have no {}, the first is node {} at ({:.6g} {:.6g} {:.6g})", path, n_bad, n_nodes,
                  n_components == 1 ? "length above 0" : "metric that is positive definite", first, x.x, x.y, x.z));
}

/// The file as it is, with values at nodes; its cells as simplices in `mesh`, and their groups.
CellFile read_cells(const std::string& file, BackgroundMesh& mesh, std::vector<std::int32_t>& group) {
  const FileName name = parse_name(file);
  const std::string &path = name.path, &array = name.array;
  const std::vector<std::string> files = files_of_size_mesh(file);
  CellFile cells = files.size() == 2            ? read_medit(files, field_number(name))
                   : has_suffix(path, {".pos"}) ? parse_pos_cells(path, MappedBytes(path).bytes())
                   : is_msh(path)               ? parse_msh_cells(path, MappedBytes(path).bytes(), array)
                   : has_suffix(path, {".vtu"}) ? parse_vtu_cells(path, MappedBytes(path).bytes(), array)
                                                : read_vtkhdf_cells(path, array);
  if (cells.node_xyz.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw Error(ExitCode::kInput, path + ": has more nodes than 2147483647");
  for (std::size_t i = 0; i < cells.node_xyz.size(); ++i)
    if (const Vec3 x = cells.node_xyz[i]; !std::isfinite(x.x + x.y + x.z))
      throw Error(ExitCode::kInput, fmt::format("{}: node {} has no place", path, i));
  mesh.node_xyz = cells.node_xyz;
  split_cells(path, cells, mesh, group);
  if (!cells.cell_value.empty()) average_cells(path, cells);
  cells.type = cells.offset = cells.node = {};  // larger than all the rest
  return cells;
}

}  // namespace

bool is_size_mesh(const std::string& file) {
  const std::string path = parse_name(file).path;
  return is_medit_mesh(path) || is_medit_solution(path) || is_msh(path) ||
         has_suffix(path, {".pos", ".vtu", ".vtkhdf", ".hdf", ".h5"});
}

std::vector<std::string> files_of_size_mesh(const std::string& file) {
  const auto [path, array, solution] = parse_name(file);
  if (!solution.empty()) return {path, solution};
  if (is_medit_mesh(path)) return {path, beside(path, {".sol", ".solb"}, "solution")};
  if (is_medit_solution(path)) return {beside(path, {".mesh", ".meshb"}, "mesh"), path};
  return {path};
}

BackgroundMesh read_size_mesh(const std::string& file) {
  BackgroundMesh mesh;
  std::vector<std::int32_t> group;
  const CellFile cells = read_cells(file, mesh, group);
  read_sizes(parse_name(file).path, cells, mesh);
  const std::vector<std::int32_t> kept = number_used_nodes(mesh);
  keep_only(kept, mesh.node_xyz);
  keep_only(kept, mesh.node_size);
  if (!mesh.node_metric.empty()) keep_only(kept, mesh.node_metric);
  return mesh;
}

FieldMesh read_field_mesh(const std::string& file) {
  const std::string path = parse_name(file).path;
  FieldMesh field;
  CellFile cells = read_cells(file, field.mesh, field.cell_group);
  field.group_name = std::move(cells.group_name);
  if (cells.value.size() != cells.node_xyz.size())
    throw Error(ExitCode::kInput, fmt::format("{}: has {} values for {} nodes; a field of one number each is expected",
                                              file, cells.value.size(), cells.node_xyz.size()));
  const std::vector<std::int32_t> kept = number_used_nodes(field.mesh);
  keep_only(kept, field.mesh.node_xyz);
  field.value = std::move(cells.value);
  keep_only(kept, field.value);
  const auto is_bad = [](double v) { return !std::isfinite(v); };
  if (const auto bad = std::find_if(field.value.begin(), field.value.end(), is_bad); bad != field.value.end())
    throw Error(ExitCode::kInput,
                fmt::format("{}: {} of {} nodes have no number, the first is node {}", file,
                            std::count_if(field.value.begin(), field.value.end(), is_bad), field.value.size(),
                            kept[static_cast<std::size_t>(bad - field.value.begin())]));
  return field;
}

}  // namespace st
