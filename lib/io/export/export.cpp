// Meshes for other programs: which suffix is which format; STL, OBJ and PLY. The other formats have files of their own.
#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstring>
#include <limits>

#include "base/limits.h"
#include "io/export/export.h"
#include "io/export/export_formats.h"
#include "io/hdf5/artifact.h"
#include "io/hdf5/face_numbers.h"
#include "mesh/edge_segments.h"

namespace st {

static_assert(kMaxTriangles <= std::numeric_limits<std::uint32_t>::max(),
              "binary STL counts its triangles so; MSH, PLY and FRO count further");
static_assert(std::endian::native == std::endian::little, "the binary formats below are written as they are in memory");

Vec3 triangle_normal(const SurfaceMesh& m, const Triangle& t) {
  const Vec3 a = m.node_xyz[t.n[0]];
  return normalized(cross(m.node_xyz[t.n[1]] - a, m.node_xyz[t.n[2]] - a));
}

std::string clean_name(std::string name, bool is_word) {
  for (char& c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < ' ' || byte == 0x7f || (is_word && byte == ' ')) c = '_';
    if (c == '"') c = '\'';
  }
  return name;
}

/// Binary STL: one solid, 32-bit coordinates.
void export_stl(Output& out, const SurfaceMesh& m) {
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
void export_ascii_stl(Output& out, const SurfaceMesh& m) {
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

/// "face_17_WING_UPPER": one word, whatever the name has in it.
static std::string one_word(const std::string& prefix, std::int32_t id, const std::vector<std::string>& names) {
  std::string word = prefix + std::to_string(id + 1);
  if (id < 0 || static_cast<std::size_t>(id) >= names.size() || names[id].empty()) return word;
  return word + "_" + clean_name(names[id], true);
}

/// "face_17_WING_UPPER group_2_WING part_3_as1/bolt" of a triangle.
static std::string obj_groups(const SurfaceMesh& m, const std::vector<FaceNumbers>& divisions, std::size_t triangle) {
  const FaceId face = m.triangle_face[triangle];
  std::string words = one_word("face_", face, m.labels.face_name);
  const auto add = [&](const std::string& what, std::int32_t number, const std::vector<std::string>& names) {
    words += ' ';
    words += one_word(what + "_", number, names);
  };
  add("group", m.triangle_group[triangle], m.labels.group_name);
  for (const FaceNumbers& d : divisions)
    if ((*d.of_face)[face] != kNone) add(d.name, (*d.of_face)[face], *d.names);
  return words;
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

/// Wavefront OBJ: groups of each CAD face, its group, part and groups of further tables. Triangles of a face follow one
/// another in a canonical mesh.
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
  const std::vector<FaceNumbers> divisions = face_numbers(m);
  for (std::size_t i = 0; i < m.triangles.size(); ++i) {
    if (m.triangle_face[i] != last) buffer += "g " + obj_groups(m, divisions, i) + "\n";
    last = m.triangle_face[i];
    buffer += "f";
    for (const NodeId n : m.triangles[i].n) (buffer += ' ') += std::to_string(n + 1);
    buffer += '\n';
    if (buffer.size() > 60000) flush();
  }
  buffer += obj_lines(m);
  flush();
}

/// Binary PLY with the CAD face and the group of each triangle, parts and further tables, the requested length and
/// groups of edges and vertices of each node. Names are comments: "comment group 2 WING".
void export_ply(Output& out, const SurfaceMesh& m) {
  std::string header = "ply\nformat binary_little_endian 1.0\ncomment surface mesh\n",
              properties = "property int face\nproperty int group\n", node_properties = "property double size\n";
  const auto add_names = [&](const std::string& what, const std::vector<std::string>& names) {
    for (std::size_t i = 0; i < names.size(); ++i)
      if (!names[i].empty())
        header += "comment " + what + " " + std::to_string(i + 1) + " " + clean_name(names[i], false) + "\n";
  };
  add_names("face", m.labels.face_name);
  add_names("group", m.labels.group_name);
  std::vector<std::vector<std::int32_t>> numbers;
  for (const FaceNumbers& d : face_numbers(m)) {
    add_names(d.name, *d.names);
    properties += "property int " + d.name + "\n";
    numbers.push_back(triangle_numbers(m, d));
  }
  const std::vector<NodeGroups> of_nodes = node_groups(m);
  for (const NodeGroups& n : of_nodes) {
    add_names(n.name, n.group_name);
    node_properties += "property int " + n.name + "\n";
  }
  out.text(header + "element vertex " + std::to_string(m.n_nodes()) +
           "\nproperty double x\nproperty double y\nproperty double z\n" + node_properties + "element face " +
           std::to_string(m.n_triangles()) + "\nproperty list uchar int vertex_indices\n" + properties +
           "end_header\n");
  for (std::size_t i = 0; i < m.node_xyz.size(); ++i) {
    out.value(m.node_xyz[i]);
    out.value(m.node_size[i]);
    for (const NodeGroups& n : of_nodes) out.value(n.of_node[i]);
  }
  for (std::size_t i = 0; i < m.triangles.size(); ++i) {
    out.value(std::uint8_t{3});
    out.value(m.triangles[i]);
    out.value(m.triangle_face[i] + 1);
    out.value(m.triangle_group[i] + 1);
    for (const auto& of_triangle : numbers) out.value(of_triangle[i]);
  }
}

namespace {

/// How a format is written.
struct Format {
  const char* suffix;
  void (*write_triangles)(Output&, const SurfaceMesh&);  ///< null: it takes quadrilaterals, too
  void (*write_elements)(Output&, const SurfaceMesh&, const QuadPairs&) = nullptr;
  bool has_entity_groups = false;  ///< holds groups of edges and vertices
  bool has_mapbc = false;          ///< a list of boundaries is written next to the mesh: NAME.mapbc for NAME.ugrid
};

/// A suffix with two dots stands before the one that it ends with.
constexpr Format kFormats[] = {
    {".ascii.stl", export_ascii_stl},
    {".stl", export_stl},
    {".vtu", nullptr, export_vtu, true},
    {".obj", export_obj, nullptr, true},
    {".ply", export_ply, nullptr, true},
    {".msh", nullptr, export_msh, true},
    {".fro", export_fro},
    {".lb8.ugrid", nullptr, export_lb8_ugrid, false, true},
    {".b8.ugrid", nullptr, export_b8_ugrid, false, true},
    {".ugrid", nullptr, export_ugrid, false, true},
    {".su2", nullptr, export_su2},
    {".bdf", export_nastran},
    {".nas", export_nastran},
    {".mesh", nullptr, export_medit},
    {".off", export_off},
    {".smesh", export_smesh},
    {".poly", export_poly},
};

std::string known_suffixes(bool wants_quads) {
  std::string list;
  for (const Format& f : kFormats)
    if (!wants_quads || f.write_elements) list.append(list.empty() ? "" : ", ").append(f.suffix);
  return list;
}

/// Ends with the suffix, whatever its case.
bool has_suffix(const std::string& path, const std::string& suffix) {
  return path.size() > suffix.size() && std::equal(suffix.rbegin(), suffix.rend(), path.rbegin(), [](char a, char b) {
           return a == std::tolower(static_cast<unsigned char>(b));
         });
}

const Format& format_of(const std::string& path) {
  for (const Format& f : kFormats)
    if (has_suffix(path, f.suffix)) return f;
  const std::string name = path.substr(path.rfind('/') + 1);
  const std::size_t dot = name.rfind('.');
  throw Error(ExitCode::kUsage, path + ": unknown suffix '" + (dot == std::string::npos ? "" : name.substr(dot)) +
                                    "' for an export; use one of " + known_suffixes(false));
}

}  // namespace

void require_export_suffix(const std::string& path, bool wants_quads) {
  const Format& format = format_of(path);
  if (wants_quads && !format.write_elements)
    throw Error(ExitCode::kUsage,
                path + ": this format holds triangles only; for --quads use one of " + known_suffixes(true));
}

std::size_t export_mesh(const std::string& path, const SurfaceMesh& mesh, const QuadPairs& elements) {
  require_export_suffix(path, !elements.quads.empty());
  const Format& format = format_of(path);
  Output out(path);
  if (format.write_elements)
    format.write_elements(out, mesh, elements);
  else
    format.write_triangles(out, mesh);
  if (format.has_mapbc) {
    Output boundaries(path.substr(0, path.size() - std::strlen(format.suffix)) + ".mapbc");
    export_mapbc(boundaries, mesh);
    boundaries.commit();
  }
  out.commit();
  return format.has_entity_groups ? 0 : mesh.labels.edge_groups.size() + mesh.labels.vertex_groups.size();
}

std::size_t export_mesh(const std::string& path, const SurfaceMesh& mesh) {
  return export_mesh(path, mesh, all_triangles(mesh));
}

}  // namespace st
