#include "geometry/model/groups.h"

#include <algorithm>
#include <charconv>

#include "geometry/model/edge_faces.h"
#include "geometry/model/entity_groups.h"
#include "geometry/model/group_selection.h"
#include "geometry/model/model.h"

namespace st {
namespace {

using Mask = GroupSelection::Mask;

template <class T>
bool is_in(const std::vector<T>& list, const T& value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

/// The faces that one rule selects.
Mask select_faces(const GroupRule& rule, const ModelTables& t) {
  const GroupCriteria& wanted = rule.selection;
  GroupSelection s(rule, t, t.n_faces());
  s.select_items("faces", wanted.faces, t.labels.face_name);
  s.select_names("parts", wanted.parts, [&](FaceId f) -> const std::string& { return t.labels.part_of(f); });
  s.select_names("paths", wanted.paths, [&](FaceId f) -> const std::string& { return t.labels.path_of(f); });
  s.select_names("layers", wanted.layers, [&](FaceId f) -> const std::string& { return t.face_layer[f]; });
  s.select_names("groups", wanted.groups,
                 [&](FaceId f) -> const std::string& { return t.labels.group_name[t.labels.face_group[f]]; });
  s.select_boxes(t.face_box, t.face_tolerance);
  if (!wanted.colors.empty()) s.keep([&](FaceId f) { return is_in(wanted.colors, t.face_color[f]); });
  if (!wanted.surfaces.empty()) s.keep([&](FaceId f) { return is_in(wanted.surfaces, t.face_type[f]); });
  if (s.has_selection()) return s.take("no face matches its selection");
  s.keep([&](FaceId f) { return t.labels.group_name[t.labels.face_group[f]] == rule.name; });
  return s.take("the CAD file has no group of this name");
}

/// One group of a table, made of all its rules.
struct Group {
  const GroupRule* first = nullptr;  ///< for messages
  std::string name, role, attributes = "{}";
  const GroupRule *role_by = nullptr, *attributes_by = nullptr;
  bool has_faces = false;
};

struct Table {
  std::string name;
  std::vector<Group> groups;
  std::vector<std::int32_t> face_group;  ///< kNone: of no group that a rule names
};

std::string attributes_of(const GroupRule& rule, const ModelTables& t) {
  if (!rule.tolerance) return rule.attributes;
  const double tolerance =
      resolve_length(*rule.tolerance, {t.reference_diagonal(), t.unit_in_m}, rule.where + ": tolerance");
  char text[40];
  const std::string number(text, std::to_chars(text, text + sizeof text, tolerance).ptr);
  return "{\"tolerance\":" + number + (rule.attributes == "{}" ? "" : ",") + rule.attributes.substr(1);
}

/// Says of a group what one more rule of it says.
void describe(Group& group, const GroupRule& rule, const ModelTables& t) {
  if (rule.role) {
    if (group.role_by && group.role != *rule.role)
      fail_group(rule, "has the role " + *rule.role + ", but at " + group.role_by->where + " the role " + group.role);
    group.role = *rule.role;
    group.role_by = &rule;
  }
  const std::string attributes = attributes_of(rule, t);
  if (attributes == "{}") return;
  if (group.attributes_by && attributes != group.attributes)
    fail_group(rule, "has different attributes from those at " + group.attributes_by->where + "; give them once");
  group.attributes = attributes;
  group.attributes_by = &rule;
}

/// Index of the rule's group in its table, made where it is new.
std::int32_t group_of(Table& table, const GroupRule& rule) {
  auto& groups = table.groups;
  auto it = std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return g.name == rule.name; });
  if (it == groups.end())
    it = groups.insert(it, {&rule, rule.name, role_of_name(rule.name), "{}", nullptr, nullptr, false});
  return static_cast<std::int32_t>(it - groups.begin());
}

void add_rule(Table& table, const GroupRule& rule, const ModelTables& t) {
  const std::int32_t g = group_of(table, rule);
  describe(table.groups[g], rule, t);
  const Mask faces = select_faces(rule, t);
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    if (!faces[f]) continue;
    std::int32_t& of_face = table.face_group[f];
    if (of_face != kNone && of_face != g) {
      const Group& other = table.groups[of_face];
      fail_group(rule, t.face_label(f) + " is already in group \"" + other.name + "\" (" + other.first->where +
                           "); a face may be in one group of a table");
    }
    of_face = g;
    table.groups[g].has_faces = true;
  }
}

std::vector<Table> collect(const std::vector<GroupRule>& rules, const ModelTables& t) {
  std::vector<Table> tables(1);  // the main one first
  tables[0].face_group.assign(t.n_faces(), kNone);
  for (const GroupRule& rule : rules) {
    if (rule.of != EntityDim::kFace) continue;
    auto it = std::find_if(tables.begin(), tables.end(), [&](const Table& table) { return table.name == rule.table; });
    if (it == tables.end()) it = tables.insert(it, {rule.table, {}, std::vector<std::int32_t>(t.n_faces(), kNone)});
    add_rule(*it, rule, t);
  }
  return tables;
}

/// The groups of the file with those of the rules put over them, in the order of their first face.
void set_main_groups(const Table& table, ModelTables& t) {
  const std::vector<std::string> old_name = std::move(t.labels.group_name), old_role = std::move(t.labels.group_role);
  t.labels.group_name.clear();
  t.labels.group_role.clear();
  std::vector<std::string> attributes;
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    const std::int32_t by_rule = table.face_group[f];
    const std::string& name = by_rule == kNone ? old_name[t.labels.face_group[f]] : table.groups[by_rule].name;
    const auto known =
        std::find_if(table.groups.begin(), table.groups.end(), [&](const Group& g) { return g.name == name; });
    const std::string& role = known == table.groups.end() ? old_role[t.labels.face_group[f]] : known->role;
    auto it = std::find(t.labels.group_name.begin(), t.labels.group_name.end(), name);
    if (it == t.labels.group_name.end()) {
      it = t.labels.group_name.insert(it, name);
      t.labels.group_role.push_back(role);
      attributes.push_back(known == table.groups.end() ? "{}" : known->attributes);
    }
    t.labels.face_group[f] = static_cast<std::int32_t>(it - t.labels.group_name.begin());
  }
  t.labels.group_attributes = std::move(attributes);
}

/// Without the groups that have no face.
GroupTable stored_table(const Table& table) {
  GroupTable out;
  out.name = table.name;
  std::vector<std::int32_t> number;
  for (const Group& g : table.groups) {
    number.push_back(g.has_faces ? static_cast<std::int32_t>(out.group_name.size()) : kNone);
    if (!g.has_faces) continue;
    out.group_name.push_back(g.name);
    out.group_role.push_back(g.role);
    out.group_attributes.push_back(g.attributes);
  }
  for (const std::int32_t g : table.face_group) out.face_group.push_back(g == kNone ? kNone : number[g]);
  return out;
}

}  // namespace

const std::vector<std::string>& group_roles() {
  static const std::vector<std::string> roles = {"wall",   "symmetry", "farfield",  "inlet",
                                                 "outlet", "periodic", "interface", "other"};
  return roles;
}

const std::vector<std::string>& surface_type_names() {
  static const std::vector<std::string> names = {"plane",   "cylinder",   "cone",      "sphere", "torus", "bezier",
                                                 "bspline", "revolution", "extrusion", "offset", "other"};
  return names;
}

std::vector<EmptyGroup> apply_groups(const std::vector<GroupRule>& rules, ModelTables& t,
                                     std::span<const Box3> edge_box) {
  std::vector<EmptyGroup> empty;
  const std::vector<Table> tables = collect(rules, t);
  for (const Table& table : tables) {
    for (const Group& g : table.groups)
      if (!g.has_faces) empty.push_back({g.name, EntityDim::kFace});
  }
  set_main_groups(tables[0], t);
  for (std::size_t i = 1; i < tables.size(); ++i) t.labels.tables.push_back(stored_table(tables[i]));
  for (const EntityDim of : {EntityDim::kEdge, EntityDim::kVertex}) apply_entity_groups(of, rules, t, edge_box, empty);
  return empty;
}

std::vector<EdgeId> edges_between(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b,
                                  const ModelTables& t) {
  const EdgeFaces faces_at(t);
  const auto separates = [&](FaceId f, FaceId g) {
    return a[f] && b[g] && (t.labels.face_group[f] != t.labels.face_group[g] || (!b[f] && !a[g]));
  };
  std::vector<EdgeId> result;
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    bool is_between = false;
    const auto at = faces_at[e];
    for (std::size_t i = 0; i < at.size(); ++i)
      for (std::size_t k = 0; k < at.size(); ++k) is_between = is_between || (i != k && separates(at[i], at[k]));
    if (is_between) result.push_back(e);
  }
  return result;
}

}  // namespace st
