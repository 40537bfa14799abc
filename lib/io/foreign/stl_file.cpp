#include "io/foreign/stl_file.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/error.h"
#include "base/finite.h"
#include "base/limits.h"
#include "io/file/text_file.h"
#include "mesh/adjacency.h"

namespace st {
namespace {

constexpr std::size_t kHeader = 84, kRecord = 50;  // bytes of a binary file before the triangles, and of one

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw Error(ExitCode::kInput, path + ": " + what + "; an STL file (binary or ASCII) is expected");
}

/// Corners of triangles; of text also its solids.
struct StlContent {
  std::vector<Vec3> corners;
  std::vector<std::string> solid_name;  ///< as many as solids; empty: none told
  std::vector<std::size_t> solid_end;   ///< corners up to the end of each
};

StlContent binary_content(const std::string& bytes) {
  StlContent content;
  std::vector<Vec3>& corners = content.corners;
  const std::size_t end = whole_stl_size(bytes);
  corners.reserve((end - kHeader) / kRecord * 3);
  for (std::size_t at = kHeader; at < end; at += kRecord) {
    float xyz[9];
    std::memcpy(xyz, bytes.data() + at + 12, sizeof xyz);
    for (int k = 0; k < 9; k += 3) corners.push_back({xyz[k], xyz[k + 1], xyz[k + 2]});
  }
  return content;
}

/// Whether a word is this one, in small or capital letters.
bool is_word(std::string_view word, std::string_view wanted) {
  return std::ranges::equal(word, wanted, {}, [](char c) { return static_cast<char>(std::tolower(c)); });
}

StlContent text_content(const std::string& path, const std::string& bytes) {
  StlContent content;
  const char *at = bytes.data(), *end = at + bytes.size();
  const auto word = [&]() -> std::string_view {
    const auto is_blank = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
    while (at != end && is_blank(*at)) ++at;
    const char* from = at;
    while (at != end && !is_blank(*at)) ++at;
    return {from, static_cast<std::size_t>(at - from)};
  };
  const auto number = [&] {
    std::string_view text = word();
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || stop != text.data() + text.size() || text.empty())
      fail(path, std::string("no coordinate: ").append(text));
    return value;
  };
  /// The rest of the line without blanks around it; some lines end with a carriage return alone.
  const auto name = [&]() -> std::string {
    const char* line_end = std::find_if(at, end, [](char c) { return c == '\n' || c == '\r'; });
    std::string_view text(std::exchange(at, line_end), line_end);
    while (!text.empty() && static_cast<unsigned char>(text.front()) <= ' ') text.remove_prefix(1);
    while (!text.empty() && static_cast<unsigned char>(text.back()) <= ' ') text.remove_suffix(1);
    return std::string(text);
  };
  if (!is_word(word(), "solid")) fail(path, "neither binary nor ASCII");
  content.solid_name.push_back(name());
  bool is_ended = false;
  for (std::string_view w = word(); !w.empty(); w = word()) {
    if (is_word(w, "vertex")) {
      is_ended = false;
      const double x = number(), y = number(), z = number();
      content.corners.push_back({x, y, z});
    } else if (is_word(w, "endsolid")) {
      is_ended = true;
      name();
    } else if (is_word(w, "solid")) {
      is_ended = false;
      content.solid_end.push_back(content.corners.size());
      content.solid_name.push_back(name());
    }
  }
  content.solid_end.push_back(content.corners.size());
  if (!is_ended) {
    const std::string& last = content.solid_name.back();
    throw Error(ExitCode::kInput, path + ": cut off: the last solid" + (last.empty() ? "" : " '" + last + "'") +
                                      " of the ASCII STL file has no endsolid; write it again");
  }
  return content;
}

/// Bits of a place, in which -0 equals 0, mixed (splitmix64, Steele et al. 2014).
std::uint64_t hash_of(Vec3 x) {
  std::uint64_t hash = 0;
  for (const double c : {x.x, x.y, x.z}) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(c + 0.0)) + 0x9e3779b97f4a7c15u;
    hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9u;
    hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebu;
    hash ^= hash >> 31;
  }
  return hash;
}

/// Nodes by coordinates, in the order in which they come.
std::vector<NodeId> weld(const std::vector<Vec3>& corners, std::vector<Vec3>& nodes) {
  std::vector<NodeId> table(std::bit_ceil(corners.size() + corners.size() / 2), kNone), node;  // open addressing
  node.reserve(corners.size());
  for (const Vec3 x : corners) {
    std::size_t at = hash_of(x) & (table.size() - 1);
    while (table[at] != kNone && !(nodes[table[at]] == x)) at = (at + 1) & (table.size() - 1);
    if (table[at] == kNone) {
      table[at] = static_cast<NodeId>(nodes.size());
      nodes.push_back(x);
    }
    node.push_back(table[at]);
  }
  return node;
}

StlContent read_content(const std::string& path) {
  const std::string bytes = read_text_file(path);
  return is_binary_stl(bytes, bytes.size()) ? binary_content(bytes) : text_content(path, bytes);
}

}  // namespace

std::uint64_t whole_stl_size(std::string_view head) {
  std::uint32_t n = 0;
  if (head.size() < kHeader) return 0;
  std::memcpy(&n, head.data() + 80, sizeof n);
  return kHeader + kRecord * static_cast<std::uint64_t>(n);
}

bool is_binary_stl(std::string_view head, std::uint64_t file_size) {
  const std::uint64_t whole = whole_stl_size(head);
  if (whole == 0 || whole > file_size) return false;
  return whole == file_size || (whole > kHeader && (file_size - whole) % kRecord != 0);
}

SurfaceMesh read_stl(const std::string& path) {
  const StlContent content = read_content(path);
  const std::vector<Vec3>& corners = content.corners;
  if (corners.empty() || corners.size() % 3 != 0) fail(path, "no whole triangles in it");
  for (const Vec3& x : corners)
    if (!is_finite(x)) fail(path, "a coordinate is not finite");
  if (corners.size() / 3 > kMaxTriangles) fail(path, "has more triangles than can be numbered");
  SurfaceMesh mesh;
  const std::vector<NodeId> node = weld(corners, mesh.node_xyz);
  const bool has_solids = content.solid_name.size() > 1;
  std::size_t solid = 0;
  for (std::size_t i = 0; i < node.size(); i += 3) {
    if (node[i] == node[i + 1] || node[i + 1] == node[i + 2] || node[i + 2] == node[i]) continue;
    mesh.triangles.push_back({{node[i], node[i + 1], node[i + 2]}});
    while (has_solids && i >= content.solid_end[solid]) ++solid;
    if (has_solids) mesh.triangle_face.push_back(static_cast<FaceId>(solid));
  }
  const std::size_t n = mesh.triangles.size();
  mesh.node_entity_dim.assign(mesh.node_xyz.size(), static_cast<std::uint8_t>(EntityDim::kFace));
  mesh.node_entity.assign(mesh.node_xyz.size(), 0);
  mesh.node_t.assign(mesh.node_xyz.size(), 0);
  mesh.node_size.assign(mesh.node_xyz.size(), 0);
  if (has_solids) {
    mesh.labels.face_name = content.solid_name;
  } else {
    std::int32_t n_parts = 0;
    const std::vector<std::int32_t> part = node_components(mesh.triangles, mesh.n_nodes(), n_parts);
    for (const Triangle& t : mesh.triangles) mesh.triangle_face.push_back(part[t.n[0]]);
    mesh.labels.face_name.resize(static_cast<std::size_t>(n_parts));
  }
  mesh.triangle_group.assign(n, 0);
  mesh.corner_uv.assign(3 * n, {});
  mesh.labels.group_name = {"default"};
  return mesh;
}

}  // namespace st
