#include "io/foreign/triangulation_reader.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "base/finite.h"
#include "base/limits.h"
#include "io/file/byte_cursor.h"
#include "io/file/text_file.h"
#include "io/foreign/stl_file.h"
#include "io/foreign/triangulation_file.h"
#include "io/hdf5/artifact.h"
#include "mesh/adjacency.h"

namespace st {
namespace {

enum class Format { kNone, kHdf5, kMsh, kVtu, kStl, kFro, kObj, kPly };

constexpr const char* kHdf5Signature = "\x89HDF\r\n\x1a\n";
constexpr std::size_t kHead = 8192;                      // bytes from which a format is known; OBJ begins with remarks
constexpr std::size_t kStlHeader = 84, kStlRecord = 50;  // of binary STL

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw Error(ExitCode::kInput, path + ": " + what);
}

/// A line of at least six integers, as a .fro file begins with.
bool is_fro_header(std::string_view line) {
  const std::string path;
  ByteCursor words(path, line);
  int n = 0;
  for (std::string_view word = words.word(); !word.empty(); word = words.word(), ++n)
    if (word.find_first_not_of("0123456789") != std::string_view::npos) return false;
  return n >= 6 && n <= 12;
}

bool is_named_stl(const std::string& path) {
  const std::string suffix = std::filesystem::path(path).extension();
  return suffix == ".stl" || suffix == ".STL";
}

Format format_of(const std::string& path, std::string_view head, std::uint64_t file_size) {
  if (head.starts_with(kHdf5Signature)) return Format::kHdf5;
  if (file_size > 0 && file_size == whole_stl_size(head)) return Format::kStl;
  const bool has_bytes = head.find('\0') != std::string_view::npos;
  const std::size_t start = head.find_first_not_of(" \t\r\n");
  if (start == std::string_view::npos) return Format::kNone;
  head.remove_prefix(start);
  if (head.starts_with("$MeshFormat")) return Format::kMsh;
  if (head.starts_with("<?xml") || head.starts_with("<VTKFile"))
    return head.find("VTKFile") != std::string_view::npos ? Format::kVtu : Format::kNone;
  if (head.starts_with("solid") || head.starts_with("SOLID")) return Format::kStl;
  if (is_ply(head)) return Format::kPly;
  if (is_obj(head)) return Format::kObj;
  const std::size_t end = head.find('\n');
  if (end != std::string_view::npos && is_fro_header(head.substr(0, end))) return Format::kFro;
  return has_bytes && is_named_stl(path) ? Format::kStl : Format::kNone;  // a damaged one
}

std::string head_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(kHead, '\0');
  file.read(head.data(), kHead);
  head.resize(static_cast<std::size_t>(file.gcount()));
  return without_byte_order_mark(std::move(head));
}

/// A binary STL file whose size does not fit its number of triangles is not read: none tells which of both is right.
void fail_if_unlike_its_count(const std::string& path, std::string_view head, std::uint64_t file_size) {
  const std::uint64_t whole = whole_stl_size(head);
  const bool is_cut = whole > file_size;
  if (is_binary_stl(head, file_size) || head.substr(0, kStlHeader).find('\0') == std::string_view::npos ||
      (is_cut ? whole >= file_size + kStlRecord * kMaxTriangles : !is_named_stl(path)))
    return;
  fail(path, (is_cut ? "cut off" : "damaged") + std::string(": a binary STL file of this many triangles has ") +
                 std::to_string(whole) + " bytes, this one " + std::to_string(file_size) + "; write it again");
}

/// Faces: the file's surfaces in the order of their numbers, or connected parts.
void number_faces(const TriangulationFile& file, const std::vector<std::size_t>& kept, SurfaceMesh& mesh) {
  std::int32_t n_faces = 0;
  if (file.surface.size() == file.triangles.size() && !file.surface.empty()) {
    std::vector<std::int64_t> numbers;
    for (const std::size_t t : kept) numbers.push_back(file.surface[t]);
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    for (const std::size_t t : kept)
      mesh.triangle_face.push_back(
          static_cast<FaceId>(std::lower_bound(numbers.begin(), numbers.end(), file.surface[t]) - numbers.begin()));
    n_faces = static_cast<std::int32_t>(numbers.size());
    for (const std::int64_t n : numbers)
      if (!file.surface_name.empty()) mesh.labels.face_name.push_back(file.surface_name[n]);
  } else {
    const std::vector<std::int32_t> part = node_components(mesh.triangles, mesh.n_nodes(), n_faces);
    for (const Triangle& t : mesh.triangles) mesh.triangle_face.push_back(part[t.n[0]]);
  }
  mesh.labels.face_name.resize(static_cast<std::size_t>(n_faces));
}

SurfaceMesh make_mesh(const std::string& path, TriangulationFile&& file) {
  SurfaceMesh mesh;
  mesh.node_xyz = std::move(file.node_xyz);
  if (file.triangles.empty()) fail(path, "no triangles in it; export it with its faces");
  if (file.triangles.size() > kMaxTriangles || mesh.node_xyz.size() > 3 * kMaxTriangles)
    fail(path, "has more triangles than can be handled");
  const auto n_nodes = static_cast<std::int64_t>(mesh.node_xyz.size());
  for (std::int64_t n = 0; n < n_nodes; ++n)
    if (!is_finite(mesh.node_xyz[n]))
      fail(path, "the coordinates of node " + std::to_string(n + 1) + " are not finite; export the mesh again");
  for (std::size_t n = 0; n < file.node_size.size(); ++n)
    if (!(file.node_size[n] >= 0) || !std::isfinite(file.node_size[n]))
      fail(path, "the length (point data 'size') of node " + std::to_string(n + 1) + " is not positive and finite");
  std::vector<std::size_t> kept;
  for (std::size_t t = 0; t < file.triangles.size(); ++t) {
    const auto& n = file.triangles[t];
    for (const std::int64_t node : n)
      if (node < 0 || node >= n_nodes)
        fail(path, "triangle " + std::to_string(t + 1) + " names node " + std::to_string(node + 1) + " of " +
                       std::to_string(n_nodes));
    if (n[0] == n[1] || n[1] == n[2] || n[2] == n[0]) continue;
    mesh.triangles.push_back({{static_cast<NodeId>(n[0]), static_cast<NodeId>(n[1]), static_cast<NodeId>(n[2])}});
    kept.push_back(t);
  }
  mesh.node_size =
      file.node_size.size() == mesh.node_xyz.size() ? std::move(file.node_size) : std::vector<double>(n_nodes, 0);
  mesh.node_entity_dim.assign(n_nodes, static_cast<std::uint8_t>(EntityDim::kFace));
  mesh.node_entity.assign(n_nodes, 0);
  mesh.node_t.assign(n_nodes, 0);
  mesh.triangle_group.assign(mesh.triangles.size(), 0);
  mesh.corner_uv.assign(3 * mesh.triangles.size(), {});
  mesh.labels.group_name = {"default"};
  number_faces(file, kept, mesh);
  return mesh;
}

}  // namespace

std::string triangulation_format(const std::string& path) {
  std::error_code unreadable;
  const std::uint64_t size =
      std::filesystem::is_regular_file(path, unreadable) ? std::filesystem::file_size(path, unreadable) : 0;
  switch (format_of(path, head_of(path), size)) {
    case Format::kStl:
      return "an STL mesh";
    case Format::kMsh:
      return "a Gmsh mesh";
    case Format::kVtu:
      return "a VTK mesh";
    case Format::kFro:
      return "a FLITE .fro mesh";
    case Format::kObj:
      return "an OBJ mesh";
    case Format::kPly:
      return "a PLY mesh";
    case Format::kHdf5:
    case Format::kNone:
      break;
  }
  return "";
}

bool is_foreign_mesh(const std::string& path) {
  std::error_code unreadable;
  if (!std::filesystem::is_regular_file(path, unreadable)) return false;
  const std::string head = head_of(path);
  return !head.empty() && (!head.starts_with(kHdf5Signature) || is_foreign_vtkhdf(path));
}

SurfaceMesh read_triangulation(const std::string& path) {
  std::error_code code;
  if (std::filesystem::is_directory(path, code)) fail(path, "is a directory; name a file");
  if (!std::filesystem::exists(path, code)) fail(path, "no such file; check the path");
  const std::uint64_t size = std::filesystem::file_size(path, code);
  const std::string head = head_of(path);
  if (head.empty()) fail(path, "empty, or it cannot be read; check its permissions and write it again");
  switch (format_of(path, head, size)) {
    case Format::kHdf5:
      return is_foreign_vtkhdf(path) ? make_mesh(path, read_vtkhdf(path)) : read_mesh(path).mesh;
    case Format::kMsh:
      return make_mesh(path, parse_msh(path, read_text_file(path)));
    case Format::kVtu:
      return make_mesh(path, parse_vtu(path, read_text_file(path)));
    case Format::kFro:
      return make_mesh(path, parse_fro(path, read_text_file(path)));
    case Format::kObj:
      return make_mesh(path, parse_obj(path, read_text_file(path)));
    case Format::kPly:
      return make_mesh(path, parse_ply(path, read_text_file(path)));
    case Format::kStl:
      fail_if_unlike_its_count(path, head, size);
      return read_stl(path);
    case Format::kNone:
      break;
  }
  fail_if_unlike_its_count(path, head, size);
  fail(path, "not a mesh of a known format; give STL, Gmsh MSH 2.2 or 4.1, VTU, .fro, OBJ, PLY or a mesh artifact");
}

}  // namespace st
