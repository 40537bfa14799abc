#include "io/export/node_value_export.h"

namespace st {
namespace {

/// A view of `n` numbers of each node from number `first` on.
void write_view(Numbers& file, const std::string& name, const std::vector<double>& values, std::size_t n_components,
                std::size_t first, std::size_t n) {
  const std::size_t n_nodes = values.size() / n_components;
  file.line("$NodeData");
  for (const std::string& line : {std::string("1"), "\"" + name + "\"", std::string("1"), std::string("0"),
                                  std::string("3"), std::string("0"), std::to_string(n), std::to_string(n_nodes)})
    file.line(line);
  for (std::size_t i = 0; i < n_nodes; ++i) {
    file.integer(static_cast<std::int64_t>(i) + 1);
    for (std::size_t k = 0; k < n; ++k) file.real(values[i * n_components + first + k]);
    file.end();
  }
  file.end_section("NodeData");
}

}  // namespace

std::vector<double> values_at_nodes(const NodeValues& v, const ExportTask& task) {
  std::vector<double> values = v.values;
  for (const auto& [a, b] : task.mid_nodes.ends)
    for (std::size_t k = 0; k < v.n_components; ++k)
      values.push_back(0.5 * (v.values[static_cast<std::size_t>(a) * v.n_components + k] +
                              v.values[static_cast<std::size_t>(b) * v.n_components + k]));
  return values;
}

std::string component_name(const NodeValues& v, std::size_t k) {
  const std::string name = clean_name(v.name, false);
  return v.n_components == 1 ? name : name + "_" + std::to_string(k + 1);
}

void write_node_data(Numbers& file, const ExportTask& task) {
  for (const NodeValues& v : task.node_values) {
    const std::vector<double> values = values_at_nodes(v, task);
    const std::size_t n = v.n_components;
    if (n == 1 || n == 3 || n == 9)
      write_view(file, clean_name(v.name, false), values, n, 0, n);
    else
      for (std::size_t k = 0; k < n; ++k) write_view(file, component_name(v, k), values, n, k, 1);
  }
}

/// A line for each node: its number in the mesh from 0, its place, its values.
void export_csv(Output& out, const ExportTask& task) {
  TextBuffer text(out);
  text << "node,x,y,z";
  for (const NodeValues& v : task.node_values)
    for (std::size_t k = 0; k < v.n_components; ++k) text << ",\"" << component_name(v, k) << "\"";
  text << "\n";
  for (std::int64_t i = 0; i < task.n_nodes(); ++i) {
    const Vec3 x = task.xyz(i);
    text << i << "," << x.x << "," << x.y << "," << x.z;
    for (const NodeValues& v : task.node_values)
      for (std::size_t k = 0; k < v.n_components; ++k)
        text << "," << v.values[static_cast<std::size_t>(i) * v.n_components + k];
    text << "\n";
  }
  text.flush();
}

}  // namespace st
