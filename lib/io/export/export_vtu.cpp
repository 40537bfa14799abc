// VTU: arrays appended raw; names as string arrays in the field data.
#include <list>

#include "io/export/export_formats.h"
#include "io/hdf5/face_numbers.h"
#include "mesh/edge_segments.h"

namespace st {
namespace {

/// VTU arrays, appended raw: the header refers to offsets into the block behind it.
class VtuArrays {
 public:
  /// The DataArray element for `values`, which must outlive this object.
  template <class T>
  std::string add(const char* type, const std::string& name, int n_components, const std::vector<T>& values) {
    return add_block(std::string("type=\"") + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
                         std::to_string(n_components) + "\"",
                     values.data(), values.size() * sizeof(T));
  }
  /// Strings, each ended by NUL.
  std::string add_strings(const std::string& name, const std::vector<std::string>& values) {
    std::string& bytes = texts_.emplace_back();
    for (const std::string& v : values) (bytes += v.c_str()) += '\0';
    return add_block("type=\"String\" Name=\"" + name + "\" NumberOfTuples=\"" + std::to_string(values.size()) + "\"",
                     bytes.data(), bytes.size());
  }
  void write(Output& out) const {
    out.text("<AppendedData encoding=\"raw\">\n_");
    for (const auto& [data, n] : blocks_) {
      out.value(std::uint64_t{n});
      out.bytes(data, n);
    }
    out.text("\n</AppendedData>\n");
  }

 private:
  std::string add_block(const std::string& attributes, const void* data, std::size_t n) {
    const std::string element =
        "<DataArray " + attributes + " format=\"appended\" offset=\"" + std::to_string(n_bytes_) + "\"/>\n";
    blocks_.emplace_back(data, n);
    n_bytes_ += sizeof(std::uint64_t) + n;
    return element;
  }
  std::vector<std::pair<const void*, std::size_t>> blocks_;
  std::list<std::string> texts_;
  std::size_t n_bytes_ = 0;
};

/// Values of triangles as values of elements.
std::vector<std::int32_t> of_elements(const std::vector<std::int32_t>& of_triangle, const QuadPairs& elements) {
  std::vector<std::int32_t> values;
  for (const TriangleId t : elements.triangles) values.push_back(of_triangle[t]);
  for (const Quadrilateral& q : elements.quads) values.push_back(of_triangle[q.triangle]);
  return values;
}

std::vector<std::int32_t> one_based(const std::vector<std::int32_t>& ids) {
  std::vector<std::int32_t> shifted(ids);
  for (std::int32_t& id : shifted) ++id;
  return shifted;
}

/// Names of faces, groups, parts and groups of further tables; VTK complains of empty arrays.
std::string field_data(const SurfaceMesh& m, VtuArrays& arrays) {
  std::string text = "<FieldData>\n";
  if (!m.labels.face_name.empty()) text += arrays.add_strings("face_name", m.labels.face_name);
  if (!m.labels.group_name.empty()) text += arrays.add_strings("group_name", m.labels.group_name);
  for (const FaceNumbers& d : face_numbers(m)) text += arrays.add_strings(d.name + "_name", *d.names);
  for (const NodeGroups& n : node_groups(m)) text += arrays.add_strings(n.name + "_name", n.group_name);
  return text + "</FieldData>\n";
}

}  // namespace

void export_vtu(Output& out, const SurfaceMesh& m, const QuadPairs& elements) {
  constexpr std::uint8_t kTriangle = 5, kQuad = 9;  // VTK's cell types
  std::vector<std::int32_t> connectivity;
  std::vector<std::int64_t> offsets;
  std::vector<std::uint8_t> types;
  const auto add_cell = [&](const auto& nodes, std::uint8_t type) {
    connectivity.insert(connectivity.end(), std::begin(nodes), std::end(nodes));
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    types.push_back(type);
  };
  for (const TriangleId t : elements.triangles) add_cell(m.triangles[t].n, kTriangle);
  for (const Quadrilateral& q : elements.quads) add_cell(q.n, kQuad);
  const std::vector<std::int32_t> face = one_based(of_elements(m.triangle_face, elements)),
                                  group = one_based(of_elements(m.triangle_group, elements)),
                                  entity = one_based(m.node_entity);
  std::list<std::vector<std::int32_t>> numbers;
  VtuArrays arrays;
  out.text(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<UnstructuredGrid>\n");
  out.text(field_data(m, arrays));
  out.text("<Piece NumberOfPoints=\"" + std::to_string(m.n_nodes()) + "\" NumberOfCells=\"" +
           std::to_string(types.size()) + "\">\n");
  out.text("<Points>\n" + arrays.add("Float64", "Points", 3, m.node_xyz) + "</Points>\n");
  out.text("<Cells>\n" + arrays.add("Int32", "connectivity", 1, connectivity) +
           arrays.add("Int64", "offsets", 1, offsets) + arrays.add("UInt8", "types", 1, types) + "</Cells>\n");
  out.text("<CellData>\n" + arrays.add("Int32", "face", 1, face) + arrays.add("Int32", "group", 1, group));
  for (const FaceNumbers& d : face_numbers(m))
    out.text(arrays.add("Int32", d.name, 1, numbers.emplace_back(of_elements(triangle_numbers(m, d), elements))));
  out.text("</CellData>\n");
  out.text("<PointData>\n" + arrays.add("UInt8", "entity_dim", 1, m.node_entity_dim) +
           arrays.add("Int32", "entity_id", 1, entity) + arrays.add("Float64", "size", 1, m.node_size));
  for (NodeGroups& n : node_groups(m))
    out.text(arrays.add("Int32", n.name, 1, numbers.emplace_back(std::move(n.of_node))));
  out.text("</PointData>\n");
  out.text("</Piece>\n</UnstructuredGrid>\n");
  arrays.write(out);
  out.text("</VTKFile>\n");
}

}  // namespace st
