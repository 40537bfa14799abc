// CGNS: one unstructured zone of surface elements; a family with a boundary condition for each group, a section for the
// triangles and one for the quadrilaterals of each, and a boundary that names the family.
#include <algorithm>
#include <map>
#include <set>

#include "base/face_labels.h"
#include "io/export/export_formats.h"
#include "io/export/node_value_export.h"
#include "io/export/periodic_motion.h"
#include "io/hdf5/cgns_tree.h"
#include "mesh/pair_match.h"

namespace st {
namespace {

constexpr std::size_t kMaxName = 32;  // bytes of a node's name

/// At most `size` bytes, not cut inside a character of UTF-8.
std::string shortened(std::string name, std::size_t size) {
  if (name.size() <= size) return name;
  while (size > 0 && (static_cast<unsigned char>(name[size]) & 0xc0) == 0x80) --size;
  name.resize(size);
  return name;
}

/// A name of at most 32 bytes that is in `used` not yet; it is afterwards.
std::string free_name(const std::string& wanted, std::set<std::string>& used) {
  std::string name = shortened(wanted, kMaxName);
  for (int k = 2; used.contains(name); ++k) {
    const std::string end = std::to_string(k);
    name = shortened(wanted, kMaxName - 1 - end.size()).append("_").append(end);
  }
  used.insert(name);
  return name;
}

/// Of a group, without '/' and control characters.
std::string node_name(const std::string& group) {
  std::string name = clean_name(group, false);
  std::replace(name.begin(), name.end(), '/', '_');
  return name.empty() || name == "." || name == ".." ? "group" : name;
}

const char* boundary_type(const FaceLabels& labels, std::size_t group) {
  const std::string role =
      group < labels.group_role.size() ? labels.group_role[group] : role_of_name(labels.group_name[group]);
  if (role == "periodic") return "UserDefined";  // no condition of the SIDS: the connectivity says it
  return role == "farfield" ? "BCFarfield" : role == "symmetry" ? "BCSymmetryPlane" : "BCWall";
}

/// Says that data of `node` and below have units; names of these for length and angle.
void add_units(CgnsTree& tree, CgnsTree::Node node, const std::string& length, const std::string& angle) {
  tree.add_text(node, "DataClass", "DataClass_t", "Dimensional");
  std::string units;
  for (const std::string& quantity :
       {std::string("Null"), length, std::string("Null"), std::string("Null"), angle}) {  // mass, -, time, temperature,
                                                                                          // -
    units += quantity;
    units.resize((units.size() + kMaxName - 1) / kMaxName * kMaxName, ' ');
  }
  tree.add_text(node, "DimensionalUnits", "DimensionalUnits_t", units, {5, kMaxName});
}

/// The unit of length, where CGNS has a name for it; false: it has not.
bool add_unit(CgnsTree& tree, CgnsTree::Node base, const std::string& unit) {
  static const std::map<std::string, std::string> names = {
      {"m", "Meter"}, {"cm", "Centimeter"}, {"mm", "Millimeter"}, {"ft", "Foot"}, {"in", "Inch"}};
  const auto name = names.find(unit);
  if (name == names.end()) return false;
  add_units(tree, base, name->second, "Null");
  return true;
}

void add_coordinates(CgnsTree& tree, CgnsTree::Node zone, const ExportTask& task, bool has_unit) {
  const CgnsTree::Node grid = tree.add(zone, "GridCoordinates", "GridCoordinates_t");
  std::vector<double> values(static_cast<std::size_t>(task.n_nodes()));
  for (const auto& [name, axis] :
       {std::pair("CoordinateX", &Vec3::x), std::pair("CoordinateY", &Vec3::y), std::pair("CoordinateZ", &Vec3::z)}) {
    for (std::size_t n = 0; n < values.size(); ++n) values[n] = task.xyz(static_cast<std::int64_t>(n)).*axis;
    const CgnsTree::Node array = tree.add_reals(grid, name, "DataArray_t", values);
    if (has_unit) tree.add_reals(array, "DimensionalExponents", "DimensionalExponents_t", {0, 1, 0, 0, 0});
  }
}

/// Names of what belongs to each group.
struct GroupNames {
  std::vector<std::string> family;
  std::set<std::string> used_in_zone = {"ZoneType", "GridCoordinates", "ZoneBC", "NodeValues", "ZoneGridConnectivity"};
};

/// The elements of one kind of one group as a section, numbered on from `next`.
void add_section(CgnsTree& tree, CgnsTree::Node zone, const std::string& name, std::int32_t type,
                 const ExportTask& task, std::span<const std::int64_t> elements, std::int32_t& next) {
  if (elements.empty()) return;
  std::vector<std::int32_t> nodes;
  for (const std::int64_t e : elements)
    for (const std::int64_t n : task.nodes_of(e)) nodes.push_back(static_cast<std::int32_t>(n) + 1);
  const std::int32_t last = next + static_cast<std::int32_t>(elements.size()) - 1;
  const CgnsTree::Node section = tree.add_integers(zone, name, "Elements_t", {type, 0});
  tree.add_integers(section, "ElementRange", "IndexRange_t", {next, last});
  tree.add_integers(section, "ElementConnectivity", "DataArray_t", nodes);
  next = last + 1;
}

void add_families(CgnsTree& tree, CgnsTree::Node base, const FaceLabels& labels, GroupNames& names) {
  std::set<std::string> used = {"Zone", "DataClass", "DimensionalUnits"};
  for (std::size_t g = 0; g < labels.group_name.size(); ++g) {
    names.family.push_back(free_name(node_name(labels.group_name[g]), used));
    const CgnsTree::Node family = tree.add(base, names.family[g], "Family_t");
    tree.add_text(family, "FamBC", "FamilyBC_t", boundary_type(labels, g));
    if (names.family[g] != labels.group_name[g])
      tree.add_text(family, "FullName", "Descriptor_t", labels.group_name[g]);
  }
}

/// Arrays of three numbers by the names that the SIDS gives a vector's components.
void add_node_values(CgnsTree& tree, CgnsTree::Node zone, const ExportTask& task) {
  if (task.node_values.empty()) return;
  const CgnsTree::Node solution = tree.add(zone, "NodeValues", "FlowSolution_t");
  tree.add_text(solution, "GridLocation", "GridLocation_t", "Vertex");
  tree.add_text(solution, "DataClass", "DataClass_t", "UserDefined");  // their units are not known
  std::set<std::string> used = {"GridLocation", "DataClass"};
  for (const NodeValues& v : task.node_values) {
    const std::vector<double> all = values_at_nodes(v, task);
    for (std::size_t k = 0; k < v.n_components; ++k) {
      std::vector<double> values;
      for (std::size_t i = k; i < all.size(); i += v.n_components) values.push_back(all[i]);
      const std::string name = v.n_components == 3 ? v.name + "XYZ"[k] : component_name(v, k);
      tree.add_reals(solution, free_name(node_name(name), used), "DataArray_t", values);
    }
  }
}

using NodePairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

/// Nodes of both faces from 1, those on the sides of curved elements too: of face a, of face b.
NodePairs paired_nodes(const ExportTask& task, const FacePair& pair) {
  const SurfaceMesh& m = task.mesh;
  std::map<std::int64_t, std::int64_t> partner;
  for (const auto& [a, b] : match_pair(m, pair, pair_tolerance(m)).nodes) partner[a] = b;
  const std::map<std::int64_t, std::int64_t> corners = partner;
  const auto image = [&](std::int64_t n) { return static_cast<NodeId>(corners.contains(n) ? corners.at(n) : kNone); };
  for (std::int64_t i = 0; !task.mid_nodes.empty() && i < task.n_elements(); ++i) {
    if (m.triangle_face[task.triangle_of(i)] != pair.a) continue;
    const std::vector<std::int64_t> nodes = task.nodes_of(i);
    const std::size_t n = nodes.size() / 2;
    for (std::size_t k = 0; k < n; ++k) {
      const NodeId from = image(nodes[k]), to = image(nodes[(k + 1) % n]);
      const std::int64_t middle =
          from == kNone || to == kNone ? task.mid_nodes.size() : task.mid_nodes.between(from, to);
      if (middle < task.mid_nodes.size() &&
          task.mid_nodes.ends[middle] == std::array{std::min(from, to), std::max(from, to)})
        partner[nodes[n + k]] = m.n_nodes() + middle;
    }
  }
  NodePairs all;
  for (const auto& [a, b] : partner)
    all.emplace_back(static_cast<std::int32_t>(a) + 1, static_cast<std::int32_t>(b) + 1);
  return all;
}

/// From the current interface to the connecting one, as the SIDS have it. R4: the CGNS library opens no file with R8.
void add_motion(CgnsTree& tree, CgnsTree::Node link, const Similarity& motion, bool has_unit) {
  const CgnsTree::Node periodic =
      tree.add(tree.add(link, "GridConnectivityProperty", "GridConnectivityProperty_t"), "Periodic", "Periodic_t");
  const auto add = [&](const char* name, Vec3 v) {
    const std::vector<float> values{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    return tree.add_single_reals(periodic, name, "DataArray_t", values);
  };
  const PeriodicMotion p = periodic_motion(motion);
  const CgnsTree::Node center = add("RotationCenter", p.center), angle = add("RotationAngle", p.turns),
                       translation = add("Translation", p.translation);
  add_units(tree, angle, "Null", "Radian");
  tree.add_reals(angle, "DimensionalExponents", "DimensionalExponents_t", {0, 0, 0, 0, 1});
  if (!has_unit) return;
  for (const CgnsTree::Node length : {center, translation})
    tree.add_reals(length, "DimensionalExponents", "DimensionalExponents_t", {0, 1, 0, 0, 0});
}

/// Both ways of each periodic pair that is in the mesh: the nodes of one face, their images on the other, the motion.
void add_pairs(CgnsTree& tree, CgnsTree::Node zone, const ExportTask& task, bool has_unit) {
  if (task.mesh.merged.pairs.empty()) return;
  const CgnsTree::Node all = tree.add(zone, "ZoneGridConnectivity", "ZoneGridConnectivity_t");
  const auto add = [&](const FacePair& pair, const NodePairs& nodes) {
    const std::string name = "face " + std::to_string(pair.a + 1) + " to " + std::to_string(pair.b + 1);
    const CgnsTree::Node link = tree.add_text(all, name, "GridConnectivity_t", "Zone");
    tree.add_text(link, "GridConnectivityType", "GridConnectivityType_t", "Abutting1to1");
    tree.add_text(link, "GridLocation", "GridLocation_t", "Vertex");
    std::vector<std::int32_t> own, donor;
    for (const auto& [a, b] : nodes) {
      own.push_back(a);
      donor.push_back(b);
    }
    tree.add_integers(link, "PointList", "IndexArray_t", own, {own.size(), 1});
    tree.add_integers(link, "PointListDonor", "IndexArray_t", donor, {donor.size(), 1});
    add_motion(tree, link, pair.motion, has_unit);
  };
  for (const FacePair& pair : task.mesh.merged.pairs) {
    NodePairs nodes = paired_nodes(task, pair);
    if (nodes.empty()) continue;
    add(pair, nodes);
    for (auto& [a, b] : nodes) std::swap(a, b);
    std::sort(nodes.begin(), nodes.end());
    add({pair.b, pair.a, pair.motion.inverse()}, nodes);
  }
}

}  // namespace

void export_cgns(Output& out, const ExportTask& task) {
  constexpr std::int32_t kCellDim = 2, kSpaceDim = 3;
  constexpr std::int32_t kTri3 = 5, kTri6 = 6, kQuad4 = 7, kQuad8 = 8;  // CGNS's element types
  const bool is_curved = !task.mid_nodes.empty();
  CgnsTree tree;
  const CgnsTree::Node base = tree.add_integers(tree.root(), "Base", "CGNSBase_t", {kCellDim, kSpaceDim});
  const bool has_unit = add_unit(tree, base, task.options.unit);
  GroupNames names;
  add_families(tree, base, task.mesh.labels, names);
  const CgnsTree::Node zone = tree.add_integers(
      base, "Zone", "Zone_t",
      {static_cast<std::int32_t>(task.n_nodes()), static_cast<std::int32_t>(task.n_elements()), 0}, {3, 1});
  tree.add_text(zone, "ZoneType", "ZoneType_t", "Unstructured");
  add_coordinates(tree, zone, task, has_unit);
  const std::vector<std::vector<std::int64_t>> of_group = elements_by_group(task);
  std::vector<std::array<std::int32_t, 2>> range(of_group.size());
  std::int32_t next = 1;
  for (std::size_t g = 0; g < of_group.size(); ++g) {
    range[g][0] = next;
    const std::span<const std::int64_t> all(of_group[g]);
    const auto n_triangles =
        static_cast<std::size_t>(std::lower_bound(all.begin(), all.end(), task.n_triangles()) - all.begin());
    const std::string name = free_name(names.family[g], names.used_in_zone);
    add_section(tree, zone, name, is_curved ? kTri6 : kTri3, task, all.first(n_triangles), next);
    add_section(tree, zone, n_triangles > 0 ? free_name(names.family[g] + " quads", names.used_in_zone) : name,
                is_curved ? kQuad8 : kQuad4, task, all.subspan(n_triangles), next);
    range[g][1] = next - 1;
  }
  const CgnsTree::Node boundaries = tree.add(zone, "ZoneBC", "ZoneBC_t");
  for (std::size_t g = 0; g < of_group.size(); ++g) {
    if (of_group[g].empty()) continue;
    const CgnsTree::Node boundary = tree.add_text(boundaries, names.family[g], "BC_t", "FamilySpecified");
    tree.add_text(boundary, "FamilyName", "FamilyName_t", names.family[g]);
    tree.add_integers(boundary, "PointRange", "IndexRange_t", {range[g][0], range[g][1]}, {2, 1});
    tree.add_text(boundary, "GridLocation", "GridLocation_t", "CellCenter");
  }
  add_node_values(tree, zone, task);
  add_pairs(tree, zone, task, has_unit);
  const std::string bytes = tree.bytes();
  out.bytes(bytes.data(), bytes.size());
}

}  // namespace st
