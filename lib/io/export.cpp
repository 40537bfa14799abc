// Meshes for other programs: STL, VTU, OBJ, PLY.
#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>
#include <span>
#include <string_view>

#include "base/error.h"
#include "io/artifact.h"
#include "io/temporary_file.h"

namespace st {
namespace {

static_assert(std::endian::native == std::endian::little, "the binary formats below are written as they are in memory");

/// A buffered file that appears only when it is complete. All functions throw Error(kOutput).
class Output {
 public:
  explicit Output(const std::string& path) : temporary_(path), file_(std::fopen(temporary_.name().c_str(), "wb")) {
    if (!file_) fail();
  }
  ~Output() {
    if (file_) std::fclose(file_);
  }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  void text(std::string_view text) { bytes(text.data(), text.size()); }
  void bytes(const void* data, std::size_t n) {
    if (n && std::fwrite(data, 1, n, file_) != n) fail();
  }
  template <class T>
  void value(const T& v) {
    bytes(&v, sizeof v);
  }
  template <class T>
  void values(const std::vector<T>& v) {
    bytes(v.data(), v.size() * sizeof(T));
  }
  void commit() {
    const int status = std::fclose(std::exchange(file_, nullptr));
    if (status != 0) fail();
    temporary_.commit();
  }

 private:
  [[noreturn]] void fail() const {
    throw Error(ExitCode::kOutput,
                temporary_.path() + ": cannot be written (" + std::strerror(errno) + "); free some space or choose another directory");
  }
  TemporaryFile temporary_;
  std::FILE* file_ = nullptr;
};

/// Shortest text that reads back as the same number.
std::string number(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

Vec3 triangle_normal(const SurfaceMesh& m, const Triangle& t) {
  const Vec3 a = m.node_xyz[t.n[0]];
  return normalized(cross(m.node_xyz[t.n[1]] - a, m.node_xyz[t.n[2]] - a));
}

/// Binary STL: one solid, 32-bit coordinates.
void export_stl(Output& out, const SurfaceMesh& m) {
  char header[80] = "surface mesh";
  out.bytes(header, sizeof header);
  out.value(static_cast<std::uint32_t>(m.triangles.size()));
  for (const Triangle& t : m.triangles) {
    float record[12];
    const std::array<Vec3, 4> vectors = {triangle_normal(m, t), m.node_xyz[t.n[0]], m.node_xyz[t.n[1]], m.node_xyz[t.n[2]]};
    for (int i = 0; i < 4; ++i) {
      record[3 * i] = static_cast<float>(vectors[i].x);
      record[3 * i + 1] = static_cast<float>(vectors[i].y);
      record[3 * i + 2] = static_cast<float>(vectors[i].z);
    }
    out.bytes(record, sizeof record);
    out.value(std::uint16_t{0});
  }
}

/// "face_17_WING_UPPER": one word, whatever the name has in it.
std::string one_word(const std::string& prefix, FaceId id, const std::vector<std::string>& names) {
  std::string word = prefix + std::to_string(id + 1);
  if (id < 0 || static_cast<std::size_t>(id) >= names.size() || names[id].empty()) return word;
  word += '_';
  word += names[id];
  std::replace_if(
      word.begin(), word.end(), [](unsigned char c) { return c <= ' ' || c == 0x7f; }, '_');
  return word;
}

/// Wavefront OBJ: one group per CAD face. Triangles of a face follow one another in a canonical mesh.
void export_obj(Output& out, const SurfaceMesh& m) {
  std::string buffer = "# surface mesh\n";
  const auto flush = [&] {
    out.text(buffer);
    buffer.clear();
  };
  for (const Vec3& p : m.node_xyz) {
    buffer += "v " + number(p.x) + " " + number(p.y) + " " + number(p.z) + "\n";
    if (buffer.size() > 60000) flush();
  }
  FaceId last = kNone;
  for (std::size_t i = 0; i < m.triangles.size(); ++i) {
    if (m.triangle_face[i] != last) buffer += "g " + one_word("face_", m.triangle_face[i], m.face_name) + "\n";
    last = m.triangle_face[i];
    buffer += "f";
    for (const NodeId n : m.triangles[i].n) (buffer += ' ') += std::to_string(n + 1);
    buffer += '\n';
    if (buffer.size() > 60000) flush();
  }
  flush();
}

/// Binary PLY with the CAD face and the group of each triangle and the requested length of each node.
void export_ply(Output& out, const SurfaceMesh& m) {
  out.text("ply\nformat binary_little_endian 1.0\ncomment surface mesh\nelement vertex " + std::to_string(m.n_nodes()) +
           "\nproperty double x\nproperty double y\nproperty double z\nproperty double size\nelement face " +
           std::to_string(m.n_triangles()) +
           "\nproperty list uchar int vertex_indices\nproperty int face\nproperty int group\nend_header\n");
  for (std::size_t i = 0; i < m.node_xyz.size(); ++i) {
    out.value(m.node_xyz[i]);
    out.value(m.node_size[i]);
  }
  for (std::size_t i = 0; i < m.triangles.size(); ++i) {
    out.value(std::uint8_t{3});
    out.value(m.triangles[i]);
    out.value(m.triangle_face[i] + 1);
    out.value(m.triangle_group[i] + 1);
  }
}

/// VTU arrays, appended raw: the header refers to offsets into the block behind it.
class VtuArrays {
 public:
  /// The DataArray element for `values`, which must outlive this object.
  template <class T>
  std::string add(const char* type, const char* name, int n_components, const std::vector<T>& values) {
    const std::string element = std::string("<DataArray type=\"") + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
                                std::to_string(n_components) + "\" format=\"appended\" offset=\"" + std::to_string(n_bytes_) + "\"/>\n";
    blocks_.emplace_back(values.data(), values.size() * sizeof(T));
    n_bytes_ += sizeof(std::uint64_t) + blocks_.back().second;
    return element;
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
  std::vector<std::pair<const void*, std::size_t>> blocks_;
  std::size_t n_bytes_ = 0;
};

std::vector<std::int32_t> one_based(const std::vector<std::int32_t>& ids) {
  std::vector<std::int32_t> shifted(ids);
  for (std::int32_t& id : shifted) ++id;
  return shifted;
}

void export_vtu(Output& out, const SurfaceMesh& m) {
  std::vector<std::int32_t> connectivity;
  std::vector<std::int64_t> offsets;
  for (const Triangle& t : m.triangles) {
    connectivity.insert(connectivity.end(), t.n, t.n + 3);
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  }
  const std::vector<std::uint8_t> types(m.triangles.size(), 5);
  const std::vector<std::int32_t> face = one_based(m.triangle_face), group = one_based(m.triangle_group), entity = one_based(m.node_entity);
  VtuArrays arrays;
  out.text(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<UnstructuredGrid>\n");
  out.text("<Piece NumberOfPoints=\"" + std::to_string(m.n_nodes()) + "\" NumberOfCells=\"" + std::to_string(m.n_triangles()) + "\">\n");
  out.text("<Points>\n" + arrays.add("Float64", "Points", 3, m.node_xyz) + "</Points>\n");
  out.text("<Cells>\n" + arrays.add("Int32", "connectivity", 1, connectivity) + arrays.add("Int64", "offsets", 1, offsets) +
           arrays.add("UInt8", "types", 1, types) + "</Cells>\n");
  out.text("<CellData>\n" + arrays.add("Int32", "face", 1, face) + arrays.add("Int32", "group", 1, group) + "</CellData>\n");
  out.text("<PointData>\n" + arrays.add("UInt8", "entity_dim", 1, m.node_entity_dim) + arrays.add("Int32", "entity_id", 1, entity) +
           arrays.add("Float64", "size", 1, m.node_size) + "</PointData>\n");
  out.text("</Piece>\n</UnstructuredGrid>\n");
  arrays.write(out);
  out.text("</VTKFile>\n");
}

using Exporter = void (*)(Output&, const SurfaceMesh&);

Exporter exporter_of(const std::string& path) {
  static const std::map<std::string, Exporter> exporters = {
      {".stl", export_stl}, {".vtu", export_vtu}, {".obj", export_obj}, {".ply", export_ply}};
  const std::size_t dot = path.rfind('.');
  std::string suffix = dot == std::string::npos || path.find('/', dot) != std::string::npos ? "" : path.substr(dot);
  std::transform(suffix.begin(), suffix.end(), suffix.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto it = exporters.find(suffix);
  if (it == exporters.end())
    throw Error(ExitCode::kUsage, path + ": unknown suffix '" + suffix + "' for an export; use .stl, .vtu, .obj or .ply");
  return it->second;
}

}  // namespace

void require_export_suffix(const std::string& path) { exporter_of(path); }

void export_mesh(const std::string& path, const SurfaceMesh& mesh) {
  const Exporter exporter = exporter_of(path);
  Output out(path);
  exporter(out, mesh);
  out.commit();
}

}  // namespace st
