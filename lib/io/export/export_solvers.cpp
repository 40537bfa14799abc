// Meshes for flow solvers and volume meshers, with a number for each group: UGRID, SU2, NASTRAN, OFF, TetGen.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "base/axis.h"
#include "base/face_labels.h"
#include "base/log.h"
#include "io/export/export.h"
#include "io/export/export_formats.h"
#include "io/export/hole_points.h"
#include "io/export/periodic_motion.h"
#include "mesh/pair_match.h"
#include "sizing/metric_in_space.h"

namespace st {
namespace {

void write_nodes(TextBuffer& text, const SurfaceMesh& m, std::string_view begin, std::string_view end) {
  for (const Vec3& p : m.node_xyz) text << begin << p.x << " " << p.y << " " << p.z << end;
}

/// The coordinate axis that the normals of a group's triangles run along on the whole: 0, 1 or 2.
int axis_of(const SurfaceMesh& m, std::size_t group) {
  Vec3 area;
  for (std::size_t i = 0; i < m.triangles.size(); ++i) {
    if (static_cast<std::size_t>(m.triangle_group[i]) != group) continue;
    const auto& n = m.triangles[i].n;
    const Vec3 a = cross(m.node_xyz[n[1]] - m.node_xyz[n[0]], m.node_xyz[n[2]] - m.node_xyz[n[0]]);
    area = area + Vec3{std::abs(a.x), std::abs(a.y), std::abs(a.z)};
  }
  return largest_axis(area);
}

/// FUN3D's number of a boundary condition: viscous wall, far field, symmetry about x, y or z.
int boundary_condition(const SurfaceMesh& m, std::size_t group) {
  const std::string role =
      group < m.labels.group_role.size() ? m.labels.group_role[group] : role_of_name(m.labels.group_name[group]);
  if (role == "farfield") return 5000;
  return role == "symmetry" ? 6661 + axis_of(m, group) : 4000;
}

std::string padded(std::string text, std::size_t width) {
  if (text.size() < width) text.insert(0, width - text.size(), ' ');
  return text;
}

/// Bytes in the order that a .ugrid of this kind has.
template <class T>
void put(Output& out, T value, bool is_big_endian) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &value, sizeof value);
  if (is_big_endian) std::reverse(bytes.begin(), bytes.end());
  out.bytes(bytes.data(), bytes.size());
}

void write_binary_ugrid(Output& out, const ExportTask& task, bool is_big_endian) {
  const auto integer = [&](std::int64_t v) { put(out, static_cast<std::int32_t>(v), is_big_endian); };
  integer(task.n_nodes());
  integer(task.n_triangles());
  integer(task.n_quads());
  for (int i = 0; i < 4; ++i) integer(0);
  for (const Vec3& p : task.mesh.node_xyz)
    for (const double x : {p.x, p.y, p.z}) put(out, x, is_big_endian);
  for (std::int64_t i = 0; i < task.n_elements(); ++i)
    for (const std::int64_t n : task.nodes_of(i)) integer(n + 1);
  for (std::int64_t i = 0; i < task.n_elements(); ++i) integer(group_number(task.mesh, task.triangle_of(i)));
}

/// Numbers of an element's nodes from `first` on, with blanks between them.
TextBuffer& write_corners(TextBuffer& text, const ExportTask& task, std::int64_t element, std::int64_t first) {
  const char* before = "";
  for (const std::int64_t n : task.nodes_of(element)) {
    text << before << n + first;
    before = " ";
  }
  return text;
}

}  // namespace

/// AFLR3's UGRID: counts, nodes, triangles, quadrilaterals, then the group of each.
void export_ugrid(Output& out, const ExportTask& task) {
  TextBuffer text(out);
  text << task.n_nodes() << " " << task.n_triangles() << " " << task.n_quads() << " 0 0 0 0\n";
  write_nodes(text, task.mesh, "", "\n");
  for (std::int64_t i = 0; i < task.n_elements(); ++i) write_corners(text, task, i, 1) << "\n";
  for (std::int64_t i = 0; i < task.n_elements(); ++i) text << group_number(task.mesh, task.triangle_of(i)) << "\n";
  text.flush();
}

void export_lb8_ugrid(Output& out, const ExportTask& task) { write_binary_ugrid(out, task, false); }
void export_b8_ugrid(Output& out, const ExportTask& task) { write_binary_ugrid(out, task, true); }

/// FUN3D's list of boundaries that stands beside a UGRID file: number, boundary condition, name.
void export_mapbc(Output& out, const ExportTask& task) {
  const SurfaceMesh& m = task.mesh;
  TextBuffer text(out);
  const std::vector<std::string> words = group_words(m);
  text << static_cast<std::int64_t>(words.size()) << "\n";
  for (std::size_t g = 0; g < words.size(); ++g)
    text << static_cast<std::int64_t>(g + 1) << " " << std::int64_t{boundary_condition(m, g)} << " " << words[g]
         << "\n";
  text.flush();
}

namespace {

/// Pairs of faces by group of face a, of face b; all pairs of the same two groups go the way of the first.
using PairsOfGroups = std::map<std::pair<std::int32_t, std::int32_t>, std::vector<FacePair>>;

/// Group of each face that has triangles.
std::map<FaceId, std::int32_t> groups_of_faces(const SurfaceMesh& m) {
  std::map<FaceId, std::int32_t> group;
  for (std::size_t t = 0; t < m.triangles.size(); ++t) group[m.triangle_face[t]] = m.triangle_group[t];
  return group;
}

PairsOfGroups pairs_of_groups(const SurfaceMesh& m, const std::map<FaceId, std::int32_t>& group_of) {
  PairsOfGroups all;
  for (const FacePair& p : m.merged.pairs) {
    if (!group_of.contains(p.a) || !group_of.contains(p.b)) continue;
    const std::int32_t from = group_of.at(p.a), to = group_of.at(p.b);
    if (from != to && all.contains({to, from}))
      all[{to, from}].push_back({p.b, p.a, p.motion.inverse()});
    else
      all[{from, to}].push_back(p);
  }
  return all;
}

/// Why the groups of these pairs are no periodic markers of SU2, which are whole groups with one motion; empty: they
/// are.
std::string why_no_markers(const SurfaceMesh& m, const std::map<FaceId, std::int32_t>& group_of,
                           const std::vector<FacePair>& pairs) {
  const std::int32_t from = group_of.at(pairs[0].a), to = group_of.at(pairs[0].b);
  const auto has_others = [&](std::int32_t group) {
    const auto n = std::count_if(group_of.begin(), group_of.end(), [&](const auto& f) { return f.second == group; });
    return static_cast<std::size_t>(n) != pairs.size();
  };
  if (from == to || has_others(from) || has_others(to)) return "other faces are in them";
  Box3 box;
  for (const Vec3& x : m.node_xyz) box.add(x);
  for (const FacePair& p : pairs)
    for (const Vec3 x : {box.lo, Vec3{box.hi.x, box.lo.y, box.lo.z}, Vec3{box.lo.x, box.hi.y, box.lo.z}, box.hi})
      if (distance(p.motion(x), pairs[0].motion(x)) > pair_tolerance(box)) return "their faces move in several ways";
  // SU2 goes back with opposite turns in the same order.
  return periodic_motion(pairs[0].motion).has_own_axis ? "" : "their axis is not along x, y or z";
}

/// The lines that SU2's configuration needs for periodic pairs, as comments: a mesh has no place for them. Angles in
/// degrees; each line from the first marker to the second, SU2 goes back by itself.
void write_periodic_markers(TextBuffer& text, const SurfaceMesh& m, const std::vector<std::string>& words) {
  if (m.merged.pairs.empty()) return;
  const std::map<FaceId, std::int32_t> group_of = groups_of_faces(m);
  for (const auto& [groups, pairs] : pairs_of_groups(m, group_of)) {
    const auto [from, to] = groups;
    if (const std::string why = why_no_markers(m, group_of, pairs); !why.empty()) {
      text << "% " << words[from] << " and " << words[to] << " are no periodic markers: " << why << "\n";
      continue;
    }
    text << "% MARKER_PERIODIC= ( " << words[from] << ", " << words[to];
    const PeriodicMotion p = periodic_motion(pairs[0].motion);
    const Vec3 turns{degrees(p.turns.x), degrees(p.turns.y), degrees(p.turns.z)};
    for (const Vec3 v : {p.center, turns, p.translation})
      for (const double x : {v.x, v.y, v.z}) text << ", " << x + 0.0;  // no -0
    text << " )\n";
  }
}

}  // namespace

/// SU2: the elements, and again as boundary elements in the marker of their group.
void export_su2(Output& out, const ExportTask& task) {
  TextBuffer text(out);
  const auto element = [&](std::int64_t i) -> TextBuffer& {  // VTK's numbers of the two kinds
    return write_corners(text << (i < task.n_triangles() ? "5 " : "9 "), task, i, 0);
  };
  const std::vector<std::string> words = group_words(task.mesh);
  write_periodic_markers(text, task.mesh, words);
  text << "NDIME= 3\nNELEM= " << task.n_elements() << "\n";
  for (std::int64_t i = 0; i < task.n_elements(); ++i) element(i) << " " << i << "\n";
  text << "NPOIN= " << task.n_nodes() << "\n";
  std::int64_t number = 0;
  for (const Vec3& p : task.mesh.node_xyz) text << p.x << " " << p.y << " " << p.z << " " << number++ << "\n";
  const std::vector<std::vector<std::int64_t>> of_group = elements_by_group(task);
  text << "NMARK= " << static_cast<std::int64_t>(words.size()) << "\n";
  for (std::size_t g = 0; g < words.size(); ++g) {
    text << "MARKER_TAG= " << words[g] << "\nMARKER_ELEMS= " << static_cast<std::int64_t>(of_group[g].size()) << "\n";
    for (const std::int64_t i : of_group[g]) element(i) << "\n";
  }
  text.flush();
}

namespace {

/// A real number in a field of 16 columns, with a point: NASTRAN tells it from an integer by that.
std::string nastran_real(double value) {
  char field[32];
  for (int digits = 16; digits > 0; --digits) {
    std::snprintf(field, sizeof field, "%.*G", digits, value);
    std::string shown = field;
    if (shown.find('.') == std::string::npos) {
      const std::size_t e = shown.find('E');
      shown.insert(e == std::string::npos ? shown.size() : e, 1, '.');
    }
    if (shown.size() <= 16) return padded(std::move(shown), 16);
  }
  return std::string(16, ' ');
}

/// CTRIA3, CQUAD4, CTRIA6 or CQUAD8: number, property, nodes; eight fields of 8 columns to a line.
void write_nastran_element(TextBuffer& text, const ExportTask& task, std::int64_t i) {
  const bool is_curved = !task.mid_nodes.empty();
  text << (i < task.n_triangles() ? is_curved ? "CTRIA6  " : "CTRIA3  " : is_curved ? "CQUAD8  " : "CQUAD4  ");
  std::vector<std::int64_t> fields = {i + 1, group_number(task.mesh, task.triangle_of(i))};
  for (const std::int64_t n : task.nodes_of(i)) fields.push_back(n + 1);
  for (std::size_t k = 0; k < fields.size(); ++k)
    text << (k == 8 ? "\n        " : "") << padded(std::to_string(fields[k]), 8);
  text << "\n";
}

}  // namespace

/// NASTRAN bulk data: GRID* in fields of 16 columns, elements in fields of 8 with a property per group, its name as a
/// comment. Throws Error(kOutput) for numbers of more than 8 digits.
void export_nastran(Output& out, const ExportTask& task) {
  if (std::max(task.n_nodes(), task.n_elements()) > 99'999'999)
    throw Error(ExitCode::kOutput,
                "NASTRAN has no room for more than 99,999,999 nodes or elements; use another format");
  const std::vector<std::string>& names = task.mesh.labels.group_name;
  TextBuffer text(out);
  text << "$ surface mesh\n";
  for (std::size_t g = 0; g < names.size(); ++g)
    text << "$ property " << static_cast<std::int64_t>(g + 1) << ": " << clean_name(names[g], false) << "\n";
  text << "BEGIN BULK\n";
  for (std::size_t g = 0; g < names.size(); ++g) text << "PSHELL  " << padded(std::to_string(g + 1), 8) << "\n";
  for (std::int64_t n = 0; n < task.n_nodes(); ++n) {
    const Vec3 p = task.xyz(n);
    text << "GRID*   " << padded(std::to_string(n + 1), 16) << std::string(16, ' ') << nastran_real(p.x)
         << nastran_real(p.y) << "\n*       " << nastran_real(p.z) << "\n";
  }
  for (std::int64_t i = 0; i < task.n_elements(); ++i) write_nastran_element(text, task, i);
  text << "ENDDATA\n";
  text.flush();
}

void export_sol(const std::string& path, const SurfaceMesh& m, const SizeField& field) {
  constexpr int kScalar = 1, kMetric = 3;
  Output out(path);
  TextBuffer text(out);
  text << "MeshVersionFormatted 2\nDimension\n3\nSolAtVertices\n"
       << m.n_nodes() << "\n1 " << std::int64_t{field.is_stretched() ? kMetric : kScalar} << "\n";
  int hint = 0;
  for (const Vec3& x : m.node_xyz) {
    if (!field.is_stretched()) {
      text << field.size(x, hint) << "\n";
      continue;
    }
    const auto [xx, yy, zz, xy, yz, xz] = metric_in_space(field, x, hint);
    text << xx << " " << xy << " " << yy << " " << xz << " " << yz << " " << zz << "\n";  // lower triangle by rows
  }
  text << "End\n";
  text.flush();
  out.commit();
}

/// Geomview's OFF: nodes and triangles alone.
void export_off(Output& out, const ExportTask& task) {
  const SurfaceMesh& m = task.mesh;
  TextBuffer text(out);
  text << "OFF\n" << m.n_nodes() << " " << m.n_triangles() << " 0\n";
  write_nodes(text, m, "", "\n");
  for (const Triangle& t : m.triangles) {
    text << "3";
    for (const NodeId n : t.n) text << " " << std::int64_t{n};
    text << "\n";
  }
  text.flush();
}

/// TetGen's .smesh and .poly: facets with the group as boundary marker, a hole for each body that is no flow, no
/// regions.
static void write_tetgen(Output& out, const SurfaceMesh& m, std::string_view facet) {
  TextBuffer text(out);
  for (std::size_t g = 0; g < m.labels.group_name.size(); ++g)
    text << "# marker " << static_cast<std::int64_t>(g + 1) << ": " << clean_name(m.labels.group_name[g], false)
         << "\n";
  text << m.n_nodes() << " 3 0 0\n";
  std::int64_t number = 1;
  for (const Vec3& p : m.node_xyz) text << number++ << " " << p.x << " " << p.y << " " << p.z << "\n";
  text << m.n_triangles() << " 1\n";
  for (std::size_t i = 0; i < m.triangles.size(); ++i) {
    const auto& n = m.triangles[i].n;
    const bool has_header = !facet.empty();  // .poly: "1 polygon, 0 holes, marker" on a line of its own
    if (has_header) text << facet << group_number(m, i) << "\n";
    text << "3 " << std::int64_t{n[0] + 1} << " " << std::int64_t{n[1] + 1} << " " << std::int64_t{n[2] + 1};
    if (!has_header) text << " " << group_number(m, i);
    text << "\n";
  }
  const HolePoints holes = find_hole_points(m);
  text << static_cast<std::int64_t>(holes.points.size()) << "\n";
  number = 1;
  for (const Vec3& p : holes.points) text << number++ << " " << p.x << " " << p.y << " " << p.z << "\n";
  text << "0\n";
  text.flush();
  if (holes.n_not_found > 0)
    log_warning(std::to_string(holes.n_not_found) + " bodies have no hole point: TetGen will fill them");
}

void export_smesh(Output& out, const ExportTask& task) { write_tetgen(out, task.mesh, ""); }
void export_poly(Output& out, const ExportTask& task) { write_tetgen(out, task.mesh, "1 0 "); }

}  // namespace st
