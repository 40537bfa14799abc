// CGNS: one unstructured zone of surface elements; a family with a boundary condition for each group, a section for the
// triangles and one for the quadrilaterals of each, and a boundary that names the family.
#include <algorithm>
#include <map>
#include <set>

#include "base/face_labels.h"
#include "io/export/export_formats.h"
#include "io/hdf5/cgns_tree.h"

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
  return role == "farfield" ? "BCFarfield" : role == "symmetry" ? "BCSymmetryPlane" : "BCWall";
}

/// The unit of length, where CGNS has a name for it; false: it has not.
bool add_unit(CgnsTree& tree, CgnsTree::Node base, const std::string& unit) {
  static const std::map<std::string, std::string> names = {
      {"m", "Meter"}, {"cm", "Centimeter"}, {"mm", "Millimeter"}, {"ft", "Foot"}, {"in", "Inch"}};
  const auto name = names.find(unit);
  if (name == names.end()) return false;
  tree.add_text(base, "DataClass", "DataClass_t", "Dimensional");
  std::string units;
  for (const std::string& quantity : {std::string("Null"), name->second, std::string("Null"), std::string("Null"),
                                      std::string("Null")}) {  // mass, length, time, temperature, angle
    units += quantity;
    units.resize((units.size() + kMaxName - 1) / kMaxName * kMaxName, ' ');
  }
  tree.add_text(base, "DimensionalUnits", "DimensionalUnits_t", units, {5, kMaxName});
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
  std::set<std::string> used_in_zone = {"ZoneType", "GridCoordinates", "ZoneBC"};
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
  const std::string bytes = tree.bytes();
  out.bytes(bytes.data(), bytes.size());
}

}  // namespace st
