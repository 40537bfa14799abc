// VTU: arrays in base64; names as names of arrays in the field data.

#include "io/export/export_formats.h"
#include "io/export/node_value_export.h"
#include "io/export/vtu_writer.h"
#include "io/hdf5/face_numbers.h"
#include "mesh/edge_segments.h"

namespace st {
namespace {

/// Values of triangles as values of elements.
std::vector<std::int32_t> of_elements(const std::vector<std::int32_t>& of_triangle, const ExportTask& task) {
  std::vector<std::int32_t> values;
  for (std::int64_t i = 0; i < task.n_elements(); ++i) values.push_back(of_triangle[task.triangle_of(i)]);
  return values;
}

std::vector<std::int32_t> one_based(const std::vector<std::int32_t>& ids) {
  std::vector<std::int32_t> shifted(ids);
  for (std::int32_t& id : shifted) ++id;
  return shifted;
}

void write_field_data(Output& out, const SurfaceMesh& m) {
  out.text("<FieldData>\n");
  write_vtu_names(out, "face", m.labels.face_name);
  write_vtu_names(out, "group", m.labels.group_name);
  for (const FaceNumbers& d : face_numbers(m)) write_vtu_names(out, d.name, *d.names);
  for (const NodeGroups& n : node_groups(m)) write_vtu_names(out, n.name, n.group_name);
  out.text("</FieldData>\n");
}

/// Connectivity, offsets and types.
struct VtuCells {
  std::vector<std::int32_t> connectivity;
  std::vector<std::int64_t> offsets;
  std::vector<std::uint8_t> types;

  explicit VtuCells(const ExportTask& task) {
    constexpr std::uint8_t kTriangle = 5, kQuad = 9, kTriangle6 = 22, kQuad8 = 23;  // VTK's cell types
    const bool is_curved = !task.mid_nodes.empty();
    for (std::int64_t i = 0; i < task.n_elements(); ++i) {
      for (const std::int64_t n : task.nodes_of(i)) connectivity.push_back(static_cast<std::int32_t>(n));
      offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
      types.push_back(i < task.n_triangles() ? is_curved ? kTriangle6 : kTriangle : is_curved ? kQuad8 : kQuad);
    }
  }
};

}  // namespace

void export_vtu(Output& out, const ExportTask& task) {
  const SurfaceMesh& m = task.mesh;
  const MidNodes& mid = task.mid_nodes;
  const VtuCells cells(task);
  std::vector<double> points;
  for (std::int64_t n = 0; n < task.n_nodes(); ++n)
    for (const double x : {task.xyz(n).x, task.xyz(n).y, task.xyz(n).z}) points.push_back(x);
  std::vector<std::uint8_t> dim = m.node_entity_dim;
  dim.insert(dim.end(), mid.entity_dim.begin(), mid.entity_dim.end());
  std::vector<std::int32_t> entity = one_based(m.node_entity);
  for (const std::int32_t e : mid.entity) entity.push_back(e + 1);
  std::vector<double> size = m.node_size;
  for (const auto& [a, b] : mid.ends) size.push_back(0.5 * (m.node_size[a] + m.node_size[b]));
  begin_vtu(out);
  write_field_data(out, m);
  out.text("<Piece NumberOfPoints=\"" + std::to_string(task.n_nodes()) + "\" NumberOfCells=\"" +
           std::to_string(cells.types.size()) + "\">\n<Points>\n");
  write_vtu_array(out, "Points", points, 3);
  out.text("</Points>\n<Cells>\n");
  write_vtu_array(out, "connectivity", cells.connectivity);
  write_vtu_array(out, "offsets", cells.offsets);
  write_vtu_array(out, "types", cells.types);
  out.text("</Cells>\n<CellData>\n");
  write_vtu_array(out, "face", one_based(of_elements(m.triangle_face, task)));
  write_vtu_array(out, "group", one_based(of_elements(m.triangle_group, task)));
  for (const FaceNumbers& d : face_numbers(m)) write_vtu_array(out, d.name, of_elements(triangle_numbers(m, d), task));
  for (const TriangleValues& v : task.values) {
    std::vector<float> of_element;
    for (std::int64_t i = 0; i < task.n_elements(); ++i) of_element.push_back(v.of_triangle[task.triangle_of(i)]);
    write_vtu_array(out, v.name, of_element);
  }
  out.text("</CellData>\n<PointData>\n");
  write_vtu_array(out, "entity_dim", dim);
  write_vtu_array(out, "entity_id", entity);
  write_vtu_array(out, "size", size);
  for (NodeGroups& n : node_groups(m)) {
    n.of_node.resize(static_cast<std::size_t>(task.n_nodes()), 0);
    write_vtu_array(out, n.name, n.of_node);
  }
  for (const NodeValues& v : task.node_values)
    write_vtu_array(out, v.name, values_at_nodes(v, task), static_cast<int>(v.n_components));
  out.text("</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
}

}  // namespace st
