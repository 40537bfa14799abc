// VTU: arrays in base64; names as names of arrays in the field data.
#include <algorithm>
#include <map>

#include "io/export/export_formats.h"
#include "io/hdf5/face_numbers.h"
#include "mesh/edge_segments.h"

namespace st {
namespace {

/// Bytes in base64, padded.
std::string base64(const unsigned char* data, std::size_t n) {
  static const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text((n + 2) / 3 * 4, '=');
  char* out = text.data();
  for (std::size_t i = 0; i < n; i += 3, out += 4) {
    const std::size_t left = std::min<std::size_t>(3, n - i);
    const std::uint32_t bits = data[i] << 16 | (left > 1 ? data[i + 1] << 8 : 0) | (left > 2 ? data[i + 2] : 0);
    for (std::size_t k = 0; k <= left; ++k) out[k] = digits[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

/// As the value of an XML attribute.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

template <class T>
struct VtkType;
template <>
struct VtkType<double> {
  static constexpr const char* name = "Float64";
};
template <>
struct VtkType<std::int32_t> {
  static constexpr const char* name = "Int32";
};
template <>
struct VtkType<std::int64_t> {
  static constexpr const char* name = "Int64";
};
template <>
struct VtkType<std::uint8_t> {
  static constexpr const char* name = "UInt8";
};

/// A DataArray with its values in it, in base64. Not appended raw: meshio mistakes offsets of such a file.
template <class T>
void write_array(Output& out, const std::string& name, const std::vector<T>& values, int n_components = 1) {
  const std::uint64_t n_bytes = values.size() * sizeof(T);
  std::string bytes(sizeof n_bytes, '\0');
  std::memcpy(bytes.data(), &n_bytes, sizeof n_bytes);
  bytes.append(reinterpret_cast<const char*>(values.data()), n_bytes);
  const std::size_t n_tuples = values.size() / static_cast<std::size_t>(n_components);
  out.text(std::string("<DataArray type=\"") + VtkType<T>::name + "\" Name=\"" + escaped(name) +
           (n_components > 1 ? "\" NumberOfComponents=\"" + std::to_string(n_components) : "") +
           "\" NumberOfTuples=\"" + std::to_string(n_tuples) + "\" format=\"binary\">");
  out.text(base64(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
  out.text("</DataArray>\n");
}

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

/// One array for each name of faces, groups, parts and groups of further tables: "group:WING" holds the number of that
/// group, "face:NOSE" those of all faces of this name. Strings would be read by VTK alone.
void write_field_data(Output& out, const SurfaceMesh& m) {
  out.text("<FieldData>\n");
  const auto add_names = [&](const std::string& what, const std::vector<std::string>& names) {
    std::map<std::string, std::vector<std::int32_t>> numbers;
    std::vector<std::string> order;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i].empty()) continue;
      std::vector<std::int32_t>& of_name = numbers[clean_name(names[i], false)];
      if (of_name.empty()) order.push_back(clean_name(names[i], false));
      of_name.push_back(static_cast<std::int32_t>(i) + 1);
    }
    for (const std::string& name : order) write_array(out, what + ":" + name, numbers[name]);
  };
  add_names("face", m.labels.face_name);
  add_names("group", m.labels.group_name);
  for (const FaceNumbers& d : face_numbers(m)) add_names(d.name, *d.names);
  for (const NodeGroups& n : node_groups(m)) add_names(n.name, n.group_name);
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
  out.text(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<UnstructuredGrid>\n");
  write_field_data(out, m);
  out.text("<Piece NumberOfPoints=\"" + std::to_string(task.n_nodes()) + "\" NumberOfCells=\"" +
           std::to_string(cells.types.size()) + "\">\n<Points>\n");
  write_array(out, "Points", points, 3);
  out.text("</Points>\n<Cells>\n");
  write_array(out, "connectivity", cells.connectivity);
  write_array(out, "offsets", cells.offsets);
  write_array(out, "types", cells.types);
  out.text("</Cells>\n<CellData>\n");
  write_array(out, "face", one_based(of_elements(m.triangle_face, task)));
  write_array(out, "group", one_based(of_elements(m.triangle_group, task)));
  for (const FaceNumbers& d : face_numbers(m)) write_array(out, d.name, of_elements(triangle_numbers(m, d), task));
  out.text("</CellData>\n<PointData>\n");
  write_array(out, "entity_dim", dim);
  write_array(out, "entity_id", entity);
  write_array(out, "size", size);
  for (NodeGroups& n : node_groups(m)) {
    n.of_node.resize(static_cast<std::size_t>(task.n_nodes()), 0);
    write_array(out, n.name, n.of_node);
  }
  out.text("</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
}

}  // namespace st
