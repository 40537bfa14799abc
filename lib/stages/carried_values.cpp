#include "stages/carried_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "base/error.h"
#include "io/foreign/node_array.h"
#include "meshing/hole/node_transfer.h"

namespace st {

std::pair<std::string, std::string> file_and_array(const std::string& option, const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0 || colon + 1 == text.size())
    throw Error(ExitCode::kUsage, fmt::format("{} '{}': not of the form FILE:ARRAY", option, text));
  return {text.substr(0, colon), text.substr(colon + 1)};
}

std::vector<double> in_mesh_order(std::span<const double> of_file, std::span<const NodeId> file_node,
                                  std::size_t n_components) {
  std::vector<double> values;
  for (const NodeId n : file_node)
    for (std::size_t k = 0; k < n_components; ++k)
      values.push_back(of_file[static_cast<std::size_t>(n) * n_components + k]);
  return values;
}

std::vector<NodeValues> read_carried_values(const std::string& text, std::size_t n_nodes,
                                            std::span<const NodeId> file_node) {
  std::vector<NodeValues> arrays;
  if (text.empty()) return arrays;
  const auto [file, names] = file_and_array("--interpolate", text);
  std::istringstream rest(names);
  for (std::string name; std::getline(rest, name, ',');) {
    NodeValues& a = arrays.emplace_back();
    a.name = name.substr(name.rfind('/') + 1);
    require_free_name(a.name);
    if (std::count_if(arrays.begin(), arrays.end(), [&](const NodeValues& other) { return other.name == a.name; }) > 1)
      throw Error(ExitCode::kUsage, fmt::format("--interpolate: array '{}' is there twice; name it once", a.name));
    a.values = read_node_values(file, name, n_nodes);
    a.n_components = a.values.size() / std::max<std::size_t>(n_nodes, 1);
    if (!file_node.empty()) a.values = in_mesh_order(a.values, file_node, a.n_components);
  }
  return arrays;
}

void carry_values(const HoleMesh& old, const SurfaceMesh& now, std::vector<NodeValues>& arrays) {
  if (arrays.empty()) return;
  const std::vector<NodeStencil> stencils = find_node_stencils(old, now);
  for (NodeValues& a : arrays) a.values = transfer_values(stencils, a.values, a.n_components);
}

}  // namespace st
