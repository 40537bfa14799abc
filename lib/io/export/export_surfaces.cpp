// Formats of triangles that programs show, print or repair: STL, OBJ, PLY.
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>

#include "base/limits.h"
#include "io/export/export_formats.h"
#include "io/hdf5/face_numbers.h"
#include "mesh/edge_segments.h"

namespace st {

static_assert(kMaxTriangles <= std::numeric_limits<std::uint32_t>::max(),
              "binary STL counts its triangles so; MSH, PLY and FRO count further");
static_assert(std::endian::native == std::endian::little, "the binary formats are written as they are in memory");

static Vec3 triangle_normal(const SurfaceMesh& m, const Triangle& t) {
  const Vec3 a = m.node_xyz[t.n[0]];
  return normalized(cross(m.node_xyz[t.n[1]] - a, m.node_xyz[t.n[2]] - a));
}

/// Binary STL: one solid, 32-bit coordinates.
void export_stl(Output& out, const ExportTask& task) {
  const SurfaceMesh& m = task.mesh;
  char header[80] = "surface mesh";
  out.bytes(header, sizeof header);
  out.value(static_cast<std::uint32_t>(m.triangles.size()));
  for (const Triangle& t : m.triangles) {
    float record[12];
    const std::array<Vec3, 4> vectors = {triangle_normal(m, t), m.node_xyz[t.n[0]], m.node_xyz[t.n[1]],
                                         m.node_xyz[t.n[2]]};
    for (int i = 0; i < 4; ++i) {
      record[3 * i] = static_cast<float>(vectors[i].x);
      record[3 * i + 1] = static_cast<float>(vectors[i].y);
      record[3 * i + 2] = static_cast<float>(vectors[i].z);
    }
    out.bytes(record, sizeof record);
    out.value(std::uint16_t{0});
  }
}

/// ASCII STL: one solid per group, in the order of the groups, shortest text of the coordinates that reads back
/// exactly.
void export_ascii_stl(Output& out, const ExportTask& task) {
  const SurfaceMesh& m = task.mesh;
  TextBuffer text(out);
  std::vector<std::vector<TriangleId>> of_group(m.labels.group_name.size());
  for (std::size_t i = 0; i < m.triangles.size(); ++i)
    of_group[m.triangle_group[i]].push_back(static_cast<TriangleId>(i));
  for (std::size_t g = 0; g < of_group.size(); ++g) {
    const std::string name = clean_name(m.labels.group_name[g], true);
    text << "solid " << name << "\n";
    for (const TriangleId t : of_group[g]) {
      const Vec3 n = triangle_normal(m, m.triangles[t]);
      text << "facet normal " << n.x << " " << n.y << " " << n.z << "\nouter loop\n";
      for (const NodeId node : m.triangles[t].n) {
        const Vec3& p = m.node_xyz[node];
        text << "vertex " << p.x << " " << p.y << " " << p.z << "\n";
      }
      text << "endloop\nendfacet\n";
    }
    text << "endsolid " << name << "\n";
  }
  text.flush();
}

/// "g edge_group_1_TE" and the lines of that group, "g vertex_group_1_TIP" and its points, for every group of edges and
/// vertices.
static std::string obj_lines(const SurfaceMesh& m) {
  std::string text;
  const auto begin = [&](const char* kind, std::size_t number, const EntityGroup& g) {
    text += "g " + std::string(kind) + std::to_string(number + 1) + "_" + (g.table.empty() ? "" : g.table + ":") +
            clean_name(g.name, true) + "\n";
  };
  const auto has = [](const EntityGroup& g, std::int32_t id) {
    return std::binary_search(g.ids.begin(), g.ids.end(), id);
  };
  for (std::size_t k = 0; k < m.labels.edge_groups.size(); ++k) {
    begin("edge_group_", k, m.labels.edge_groups[k]);
    for (std::size_t i = 0; i < m.segment_edge.size(); ++i)
      if (has(m.labels.edge_groups[k], m.segment_edge[i]))
        text += "l " + std::to_string(m.segment_nodes[2 * i] + 1) + " " +
                std::to_string(m.segment_nodes[2 * i + 1] + 1) + "\n";
  }
  for (std::size_t k = 0; k < m.labels.vertex_groups.size(); ++k) {
    begin("vertex_group_", k, m.labels.vertex_groups[k]);
    for (std::size_t n = 0;
         n < m.node_entity.size() && m.node_entity_dim[n] == static_cast<std::uint8_t>(EntityDim::kVertex); ++n)
      if (has(m.labels.vertex_groups[k], m.node_entity[n])) text += "p " + std::to_string(n + 1) + "\n";
  }
  return text;
}

/// Wavefront OBJ: one group of triangles for each group with its name, CAD faces as comments.
void export_obj(Output& out, const ExportTask& task) {
  const SurfaceMesh& m = task.mesh;
  TextBuffer text(out);
  text << "# surface mesh\n";
  for (const Vec3& p : m.node_xyz) text << "v " << p.x << " " << p.y << " " << p.z << "\n";
  const std::vector<std::string> words = group_words(m);
  const std::vector<std::vector<std::int64_t>> of_group = elements_by_group(task);
  for (std::size_t g = 0; g < words.size(); ++g) {
    text << "g " << words[g] << "\n";
    FaceId last = kNone;
    for (const std::int64_t i : of_group[g]) {
      const FaceId face = m.triangle_face[i];
      const bool is_named = static_cast<std::size_t>(face) < m.labels.face_name.size();
      if (face != last)
        text << "# face " << std::int64_t{face + 1} << " "
             << (is_named ? clean_name(m.labels.face_name[face], false) : "") << "\n";
      last = face;
      text << "f";
      for (const NodeId n : m.triangles[i].n) text << " " << std::int64_t{n + 1};
      text << "\n";
    }
  }
  text << obj_lines(m);
  text.flush();
}

namespace {

/// What a PLY file says of each node and triangle beside place and corners.
struct PlyData {
  explicit PlyData(const SurfaceMesh& m) : of_nodes(node_groups(m)) {
    for (const FaceNumbers& d : face_numbers(m)) of_triangles.push_back(triangle_numbers(m, d));
  }
  std::vector<NodeGroups> of_nodes;
  std::vector<std::vector<std::int32_t>> of_triangles;
};

/// Properties, and names as comments: "comment group 2 WING".
std::string ply_header(const SurfaceMesh& m, const PlyData& data, const char* encoding) {
  std::string header = std::string("ply\nformat ") + encoding + " 1.0\ncomment surface mesh\n",
              properties = "property int face\nproperty int group\n", node_properties = "property double size\n";
  const auto add_names = [&](const std::string& what, const std::vector<std::string>& names) {
    for (std::size_t i = 0; i < names.size(); ++i)
      if (!names[i].empty())
        header += "comment " + what + " " + std::to_string(i + 1) + " " + clean_name(names[i], false) + "\n";
  };
  add_names("face", m.labels.face_name);
  add_names("group", m.labels.group_name);
  for (const FaceNumbers& d : face_numbers(m)) {
    add_names(d.name, *d.names);
    properties += "property int " + d.name + "\n";
  }
  for (const NodeGroups& n : data.of_nodes) {
    add_names(n.name, n.group_name);
    node_properties += "property int " + n.name + "\n";
  }
  return header + "element vertex " + std::to_string(m.n_nodes()) +
         "\nproperty double x\nproperty double y\nproperty double z\n" + node_properties + "element face " +
         std::to_string(m.n_triangles()) + "\nproperty list uchar int vertex_indices\n" + properties + "end_header\n";
}

}  // namespace

/// PLY with the CAD face and the group of each triangle, parts and further tables, the requested length and groups of
/// edges and vertices of each node. As text: gmsh, meshio and TetGen do not read such a file in binary.
void export_ply(Output& out, const ExportTask& task) {
  const SurfaceMesh& m = task.mesh;
  const PlyData data(m);
  TextBuffer text(out);
  text << ply_header(m, data, "ascii");
  for (std::size_t i = 0; i < m.node_xyz.size(); ++i) {
    const Vec3& p = m.node_xyz[i];
    text << p.x << " " << p.y << " " << p.z << " " << m.node_size[i];
    for (const NodeGroups& n : data.of_nodes) text << " " << std::int64_t{n.of_node[i]};
    text << "\n";
  }
  for (std::size_t i = 0; i < m.triangles.size(); ++i) {
    text << "3";
    for (const NodeId n : m.triangles[i].n) text << " " << std::int64_t{n};
    text << " " << std::int64_t{m.triangle_face[i] + 1} << " " << group_number(m, i);
    for (const auto& of_triangle : data.of_triangles) text << " " << std::int64_t{of_triangle[i]};
    text << "\n";
  }
  text.flush();
}

void export_binary_ply(Output& out, const ExportTask& task) {
  const SurfaceMesh& m = task.mesh;
  const PlyData data(m);
  out.text(ply_header(m, data, "binary_little_endian"));
  for (std::size_t i = 0; i < m.node_xyz.size(); ++i) {
    out.value(m.node_xyz[i]);
    out.value(m.node_size[i]);
    for (const NodeGroups& n : data.of_nodes) out.value(n.of_node[i]);
  }
  for (std::size_t i = 0; i < m.triangles.size(); ++i) {
    out.value(std::uint8_t{3});
    out.value(m.triangles[i]);
    out.value(m.triangle_face[i] + 1);
    out.value(m.triangle_group[i] + 1);
    for (const auto& of_triangle : data.of_triangles) out.value(of_triangle[i]);
  }
}

}  // namespace st
