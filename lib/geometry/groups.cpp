#include "geometry/groups.h"

#include <fnmatch.h>

#include <algorithm>
#include <charconv>
#include <functional>

#include "base/error.h"
#include "geometry/model.h"

namespace st {
namespace {

using Mask = std::vector<char>;  // [n_faces] 1: in the selection

constexpr double kBoxSlack = 1e-6;  // of the model's diagonal: bounding boxes are made of samples and tolerances

bool matches(const std::string& pattern, const std::string& name) {
  return !name.empty() && (name == pattern || fnmatch(pattern.c_str(), name.c_str(), 0) == 0);
}

/// "17" or "17-20"; nullopt: a name.
std::optional<std::pair<std::int64_t, std::int64_t>> as_range(const std::string& text) {
  const char *const begin = text.data(), *const end = begin + text.size();
  std::int64_t first = 0, last = 0;
  const auto a = std::from_chars(begin, end, first);
  if (a.ec != std::errc() || first < 0) return std::nullopt;
  if (a.ptr == end) return std::pair(first, first);
  const auto b = std::from_chars(a.ptr + 1, end, last);
  if (*a.ptr != '-' || b.ec != std::errc() || b.ptr != end || last < 0) return std::nullopt;
  return std::pair(first, last);
}

std::string label(const GroupRule& rule) {
  return "group \"" + rule.name + "\"" + (rule.table.empty() ? "" : " of table \"" + rule.table + "\"");
}

[[noreturn]] void fail(const GroupRule& rule, const std::string& what) {
  throw Error(ExitCode::kUsage, rule.where + ": " + label(rule) + ": " + what);
}

double coordinate(const GroupRule& rule, const CoordinateSpec& c, const ModelTables& t) {
  if (!c.is_in_metres) return c.value;
  if (!t.unit_in_m) fail(rule, "the model has no unit; give plain numbers, or --unit");
  return c.value / *t.unit_in_m;
}

/// The faces that one rule selects.
class Selection {
 public:
  Selection(const GroupRule& rule, const ModelTables& tables) : rule_(rule), t_(tables), chosen_(tables.n_faces(), 1) {}

  Mask run() {
    select_faces();
    select_names("parts", rule_.parts, [&](FaceId f) -> const std::string& { return t_.labels.part_of(f); });
    select_names("paths", rule_.paths, [&](FaceId f) -> const std::string& { return t_.labels.path_of(f); });
    select_names("layers", rule_.layers, [&](FaceId f) -> const std::string& { return t_.face_layer[f]; });
    select_names("groups", rule_.groups, [&](FaceId f) -> const std::string& { return t_.group_name[t_.face_group[f]]; });
    for (const bool is_inside : {true, false}) select_box(is_inside);
    if (!rule_.colors.empty()) keep([&](FaceId f) { return is_in(rule_.colors, t_.face_color[f]); });
    if (!rule_.surfaces.empty()) keep([&](FaceId f) { return is_in(rule_.surfaces, t_.face_type[f]); });
    const bool is_by_name = !has_selection_;
    if (is_by_name) keep([&](FaceId f) { return t_.group_name[t_.face_group[f]] == rule_.name; });
    const bool is_empty = std::find(chosen_.begin(), chosen_.end(), 1) == chosen_.end();
    if (is_empty && !rule_.is_optional)
      fail(rule_, std::string(is_by_name ? "the CAD file has no group of this name" : "no face meets its selection") +
                      "; st-info geometry.hdf --groups lists names, or say optional = true");
    return std::move(chosen_);
  }

 private:
  template <class T>
  static bool is_in(const std::vector<T>& list, const T& value) {
    return std::find(list.begin(), list.end(), value) != list.end();
  }

  void keep(const std::function<bool(FaceId)>& is_wanted) {
    has_selection_ = true;
    for (FaceId f = 0; f < t_.n_faces(); ++f) chosen_[f] = chosen_[f] && is_wanted(f);
  }

  void keep(const Mask& wanted) {
    keep([&](FaceId f) { return wanted[f] != 0; });
  }

  /// Adds the faces whose name matches an item, which must be some.
  void add_matches(const char* key, const std::string& item, const std::function<const std::string&(FaceId)>& name, Mask& wanted) const {
    bool is_used = false;
    for (FaceId f = 0; f < t_.n_faces(); ++f)
      if (matches(item, name(f))) wanted[f] = is_used = true;
    if (!is_used && !rule_.is_optional)
      fail(rule_, std::string(key) + ": '" + item + "' matches nothing; st-info geometry.hdf --groups lists names, or say optional = true");
  }

  void select_names(const char* key, const std::vector<std::string>& items, const std::function<const std::string&(FaceId)>& name) {
    if (items.empty()) return;
    Mask wanted(t_.n_faces(), 0);
    for (const std::string& item : items) add_matches(key, item, name, wanted);
    keep(wanted);
  }

  void select_faces() {
    if (rule_.faces.empty()) return;
    Mask wanted(t_.n_faces(), 0);
    for (const std::string& item : rule_.faces) {
      const auto range = as_range(item);
      if (!range) {
        add_matches(
            "faces", item, [&](FaceId f) -> const std::string& { return t_.face_name[f]; }, wanted);
        continue;
      }
      if (range->first < 1 || range->second > t_.n_faces() || range->first > range->second)
        fail(rule_, "faces: " + item + " does not exist, there are faces 1 to " + std::to_string(t_.n_faces()));
      std::fill(wanted.begin() + (range->first - 1), wanted.begin() + range->second, 1);
    }
    keep(wanted);
  }

  void select_box(bool is_inside) {
    const std::optional<BoxSpec>& spec = is_inside ? rule_.inside : rule_.touching;
    if (!spec) return;
    double c[6];
    for (int i = 0; i < 6; ++i) c[i] = coordinate(rule_, (*spec)[i], t_);
    const double slack = kBoxSlack * t_.box().diagonal();
    const Vec3 lo{c[0] - slack, c[1] - slack, c[2] - slack}, hi{c[3] + slack, c[4] + slack, c[5] + slack};
    keep([&](FaceId f) {
      const Box3& b = t_.face_box[f];
      const double tolerance = is_inside ? t_.face_tolerance[f] : 0;
      const Vec3 &low = is_inside ? b.lo : b.hi, &high = is_inside ? b.hi : b.lo;
      return low.x >= lo.x - tolerance && low.y >= lo.y - tolerance && low.z >= lo.z - tolerance && high.x <= hi.x + tolerance &&
             high.y <= hi.y + tolerance && high.z <= hi.z + tolerance;
    });
  }

  const GroupRule& rule_;
  const ModelTables& t_;
  Mask chosen_;
  bool has_selection_ = false;
};

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
  const double tolerance = resolve_length(*rule.tolerance, t.reference_diagonal(), t.unit_in_m, rule.where + ": tolerance");
  char text[40];
  const std::string number(text, std::to_chars(text, text + sizeof text, tolerance).ptr);
  return "{\"tolerance\":" + number + (rule.attributes == "{}" ? "" : ",") + rule.attributes.substr(1);
}

/// Says of a group what one more rule of it says.
void describe(Group& group, const GroupRule& rule, const ModelTables& t) {
  if (rule.role) {
    if (group.role_by && group.role != *rule.role)
      fail(rule, "has the role " + *rule.role + ", but at " + group.role_by->where + " the role " + group.role);
    group.role = *rule.role;
    group.role_by = &rule;
  }
  const std::string attributes = attributes_of(rule, t);
  if (attributes == "{}") return;
  if (group.attributes_by && attributes != group.attributes)
    fail(rule, "has other attributes than at " + group.attributes_by->where + "; give them once");
  group.attributes = attributes;
  group.attributes_by = &rule;
}

/// Index of the rule's group in its table, made where it is new.
std::int32_t group_of(Table& table, const GroupRule& rule) {
  auto& groups = table.groups;
  auto it = std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return g.name == rule.name; });
  if (it == groups.end()) it = groups.insert(it, {&rule, rule.name, role_of_name(rule.name), "{}", nullptr, nullptr, false});
  return static_cast<std::int32_t>(it - groups.begin());
}

void add_rule(Table& table, const GroupRule& rule, const ModelTables& t) {
  const std::int32_t g = group_of(table, rule);
  describe(table.groups[g], rule, t);
  const Mask faces = Selection(rule, t).run();
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    if (!faces[f]) continue;
    std::int32_t& of_face = table.face_group[f];
    if (of_face != kNone && of_face != g) {
      const Group& other = table.groups[of_face];
      fail(rule, t.face_label(f) + " is already in group \"" + other.name + "\" (" + other.first->where +
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
    auto it = std::find_if(tables.begin(), tables.end(), [&](const Table& table) { return table.name == rule.table; });
    if (it == tables.end()) it = tables.insert(it, {rule.table, {}, std::vector<std::int32_t>(t.n_faces(), kNone)});
    add_rule(*it, rule, t);
  }
  return tables;
}

/// The groups of the file with those of the rules put over them, in the order of their first face.
void set_main_groups(const Table& table, ModelTables& t) {
  const std::vector<std::string> old_name = std::move(t.group_name), old_role = std::move(t.group_role);
  t.group_name.clear();
  t.group_role.clear();
  std::vector<std::string> attributes;
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    const std::int32_t by_rule = table.face_group[f];
    const std::string& name = by_rule == kNone ? old_name[t.face_group[f]] : table.groups[by_rule].name;
    const auto known = std::find_if(table.groups.begin(), table.groups.end(), [&](const Group& g) { return g.name == name; });
    const std::string& role = known == table.groups.end() ? old_role[t.face_group[f]] : known->role;
    auto it = std::find(t.group_name.begin(), t.group_name.end(), name);
    if (it == t.group_name.end()) {
      it = t.group_name.insert(it, name);
      t.group_role.push_back(role);
      attributes.push_back(known == table.groups.end() ? "{}" : known->attributes);
    }
    t.face_group[f] = static_cast<std::int32_t>(it - t.group_name.begin());
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
  static const std::vector<std::string> roles = {"wall", "symmetry", "farfield", "inlet", "outlet", "periodic", "interface", "other"};
  return roles;
}

const std::vector<std::string>& surface_type_names() {
  static const std::vector<std::string> names = {"plane",   "cylinder",   "cone",      "sphere", "torus", "bezier",
                                                 "bspline", "revolution", "extrusion", "offset", "other"};
  return names;
}

std::vector<std::string> apply_groups(const std::vector<GroupRule>& rules, ModelTables& t) {
  std::vector<std::string> without_faces;
  const std::vector<Table> tables = collect(rules, t);
  for (const Table& table : tables) {
    for (const Group& g : table.groups)
      if (!g.has_faces) without_faces.push_back(g.name);
  }
  set_main_groups(tables[0], t);
  for (std::size_t i = 1; i < tables.size(); ++i) t.labels.tables.push_back(stored_table(tables[i]));
  return without_faces;
}

}  // namespace st
