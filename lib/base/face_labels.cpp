#include "base/face_labels.h"

#include <fnmatch.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

#include "base/nearest_name.h"
#include "base/sort_once.h"

namespace st {
namespace {

const std::string kNoName;

const std::string& label_of(const FaceLabels& labels, const std::vector<std::string>& names, FaceId f) {
  if (f < 0 || static_cast<std::size_t>(f) >= labels.face_part.size() || labels.face_part[f] < 0) return kNoName;
  return names[labels.face_part[f]];
}

template <class T>
std::vector<T> gather(const std::vector<T>& values, std::span<const FaceId> faces) {
  std::vector<T> out;
  if (values.empty()) return out;
  for (const FaceId f : faces) out.push_back(values[f]);
  return out;
}

/// Column `of_second` behind `of_first`, either of them perhaps left out.
std::vector<std::int32_t> joined(std::vector<std::int32_t> of_first, std::int32_t n_first,
                                 const std::vector<std::int32_t>& of_second, std::int32_t n_second,
                                 const std::vector<std::int32_t>& renumbered) {
  of_first.resize(n_first, kNone);
  for (std::int32_t f = 0; f < n_second; ++f)
    of_first.push_back(of_second.empty() || of_second[f] < 0 ? kNone : renumbered[of_second[f]]);
  return of_first;
}

/// Groups of `from` in the numbers of `to`, to which the new ones are added. Groups: GroupTable, or FaceLabels for the
/// main one.
template <class Groups>
std::vector<std::int32_t> merge_groups(Groups& to, const Groups& from) {
  to.group_attributes.resize(to.group_name.size(), "{}");
  std::vector<std::int32_t> number;
  for (std::size_t g = 0; g < from.group_name.size(); ++g) {
    std::size_t k = 0;
    while (k < to.group_name.size() &&
           (to.group_name[k] != from.group_name[g] || to.group_role[k] != from.group_role[g]))
      ++k;
    if (k == to.group_name.size()) {
      to.group_name.push_back(from.group_name[g]);
      to.group_role.push_back(from.group_role[g]);
      to.group_attributes.push_back(g < from.group_attributes.size() ? from.group_attributes[g] : "{}");
    }
    number.push_back(static_cast<std::int32_t>(k));
  }
  return number;
}

/// Adds the faces whose number has a matching name.
void add_matches(const std::string& pattern, const std::vector<std::string>& name,
                 const std::vector<std::int32_t>& of_face, std::vector<std::uint8_t>& is_in) {
  std::vector<std::uint8_t> is_match;
  for (const std::string& n : name) is_match.push_back(name_matches(pattern, n));
  for (std::size_t f = 0; f < std::min(is_in.size(), of_face.size()); ++f)
    if (of_face[f] >= 0 && is_match[of_face[f]]) is_in[f] = 1;
}

/// Names of a table's groups behind the table's: "bc:hot".
std::vector<std::string> full_names(const GroupTable& table) {
  std::vector<std::string> names;
  for (const std::string& name : table.group_name) names.push_back(table.name + ":" + name);
  return names;
}

/// Ids of the groups that `is_wanted` takes, ascending.
template <class Predicate>
std::vector<std::int32_t> members(const std::vector<EntityGroup>& groups, const Predicate& is_wanted) {
  std::vector<std::int32_t> ids;
  for (const EntityGroup& g : groups)
    if (is_wanted(g)) ids.insert(ids.end(), g.ids.begin(), g.ids.end());
  sort_once(ids);
  return ids;
}

/// Attribute "tolerance" of a group, 0: none.
double tolerance_in(const std::string& attributes) {
  const nlohmann::json json = nlohmann::json::parse(attributes, nullptr, false);
  const auto it = json.is_object() ? json.find("tolerance") : json.end();
  return it != json.end() && it->is_number() ? it->get<double>() : 0;
}

/// Raises the tolerances of faces to those of their groups.
void raise_tolerances(const std::vector<std::string>& attributes, const std::vector<std::int32_t>& face_group,
                      std::vector<double>& of_face) {
  std::vector<double> of_group;
  for (const std::string& a : attributes) of_group.push_back(tolerance_in(a));
  for (std::size_t f = 0; f < face_group.size(); ++f) {
    const std::int32_t g = face_group[f];
    if (g >= 0 && static_cast<std::size_t>(g) < of_group.size()) of_face[f] = std::max(of_face[f], of_group[g]);
  }
}

/// Words of a name in small letters: runs of letters, a capital behind a small letter begins a new one. Bytes beyond
/// ASCII are letters.
std::vector<std::string> words_of(const std::string& name) {
  std::vector<std::string> words(1);
  bool was_small = false;
  for (const unsigned char c : name) {
    if (!std::isalpha(c) && c < 0x80) {
      words.emplace_back();
      was_small = false;
      continue;
    }
    if (was_small && std::isupper(c)) words.emplace_back();
    words.back() += static_cast<char>(std::tolower(c));
    was_small = std::islower(c);
  }
  std::erase(words, "");
  return words;
}

}  // namespace

bool name_matches(const std::string& pattern, const std::string& name) {
  return !name.empty() && (name == pattern || fnmatch(pattern.c_str(), name.c_str(), 0) == 0);
}

const std::string& FaceLabels::part_of(FaceId f) const { return label_of(*this, part_name, f); }
const std::string& FaceLabels::path_of(FaceId f) const { return label_of(*this, part_path, f); }

FaceLabels select_labels(const FaceLabels& labels, std::span<const FaceId> faces) {
  FaceLabels out = labels;
  out.face_name = gather(labels.face_name, faces);
  out.face_group = gather(labels.face_group, faces);
  out.face_part = gather(labels.face_part, faces);
  for (GroupTable& table : out.tables) table.face_group = gather(table.face_group, faces);
  return out;
}

std::vector<std::uint8_t> find_faces(const std::string& pattern, const FaceLabels& labels) {
  std::vector<std::uint8_t> is_in(labels.face_group.size(), 0);
  const auto is_found = [&] { return std::find(is_in.begin(), is_in.end(), 1) != is_in.end(); };
  add_matches(pattern, labels.group_name, labels.face_group, is_in);
  if (is_found()) return is_in;
  for (const GroupTable& table : labels.tables) {
    add_matches(pattern, table.group_name, table.face_group, is_in);
    add_matches(pattern, full_names(table), table.face_group, is_in);
  }
  for (const std::vector<std::string>* part : {&labels.part_name, &labels.part_path})
    if (!is_found()) add_matches(pattern, *part, labels.face_part, is_in);
  return is_found() ? is_in : std::vector<std::uint8_t>();
}

std::vector<EntityGroup> select_groups(const std::vector<EntityGroup>& groups, std::span<const std::int32_t> place) {
  std::vector<EntityGroup> selected;
  for (const EntityGroup& g : groups) {
    EntityGroup part{g.name, g.table, g.attributes, {}};
    for (const std::int32_t id : g.ids)
      if (place[id] != kNone) part.ids.push_back(place[id]);
    std::sort(part.ids.begin(), part.ids.end());
    if (!part.ids.empty()) selected.push_back(std::move(part));
  }
  return selected;
}

void append_groups(std::vector<EntityGroup>& to, const std::vector<EntityGroup>& more, std::int32_t shift) {
  for (const EntityGroup& g : more) {
    auto it = std::find_if(to.begin(), to.end(),
                           [&](const EntityGroup& own) { return own.name == g.name && own.table == g.table; });
    if (it == to.end()) it = to.insert(it, {g.name, g.table, g.attributes, {}});
    for (const std::int32_t id : g.ids) it->ids.push_back(id + shift);
  }
}

std::vector<std::int32_t> find_members(const std::string& pattern, const std::vector<EntityGroup>& groups) {
  const auto main =
      members(groups, [&](const EntityGroup& g) { return g.table.empty() && name_matches(pattern, g.name); });
  if (!main.empty()) return main;
  return members(groups, [&](const EntityGroup& g) {
    return !g.table.empty() && (name_matches(pattern, g.name) || name_matches(pattern, g.table + ":" + g.name));
  });
}

std::string say_other_kind(const std::string& pattern, const FaceLabels& labels) {
  if (!find_members(pattern, labels.edge_groups).empty()) return " (it names a group of edges)";
  if (!find_members(pattern, labels.vertex_groups).empty()) return " (it names a group of vertices)";
  std::vector<std::string> names = labels.group_name;
  const auto add = [&](const std::vector<std::string>& more) { names.insert(names.end(), more.begin(), more.end()); };
  for (const GroupTable& table : labels.tables) add(table.group_name);
  add(labels.part_name);
  add(labels.part_path);
  for (const std::vector<EntityGroup>* groups : {&labels.edge_groups, &labels.vertex_groups})
    for (const EntityGroup& g : *groups) names.push_back(g.name);
  for (const GroupTable& table : labels.tables) add(full_names(table));
  return did_you_mean(pattern, names);
}

std::vector<double> face_tolerances(const FaceLabels& labels) {
  std::vector<double> of_face(labels.face_group.size(), 0);
  raise_tolerances(labels.group_attributes, labels.face_group, of_face);
  for (const GroupTable& table : labels.tables) raise_tolerances(table.group_attributes, table.face_group, of_face);
  const bool has_any = std::any_of(of_face.begin(), of_face.end(), [](double t) { return t > 0; });
  return has_any ? of_face : std::vector<double>();
}

std::string unique_path(const std::string& path, const std::vector<std::string>& taken) {
  std::string candidate = path;
  for (int k = 2; std::find(taken.begin(), taken.end(), candidate) != taken.end(); ++k)
    candidate = path + "#" + std::to_string(k);
  return candidate;
}

FaceLabels append_labels(const FaceLabels& first, std::int32_t n_first, const FaceLabels& second,
                         std::int32_t n_second) {
  FaceLabels out = first;
  std::vector<std::int32_t> part;
  for (std::size_t p = 0; p < second.part_name.size(); ++p) {
    part.push_back(static_cast<std::int32_t>(out.part_name.size()));
    out.part_path.push_back(unique_path(second.part_path[p], out.part_path));
    out.part_name.push_back(second.part_name[p]);
  }
  out.face_name.insert(out.face_name.end(), second.face_name.begin(), second.face_name.end());
  const std::vector<std::int32_t> group = merge_groups(out, second);
  out.face_group = joined(std::move(out.face_group), n_first, second.face_group, n_second, group);
  if (!first.face_part.empty() || !second.face_part.empty())
    out.face_part = joined(std::move(out.face_part), n_first, second.face_part, n_second, part);
  for (const GroupTable& table : second.tables)
    if (std::none_of(out.tables.begin(), out.tables.end(), [&](const GroupTable& t) { return t.name == table.name; }))
      out.tables.push_back({table.name, {}, {}, {}, {}});
  for (GroupTable& table : out.tables) {
    const auto same = std::find_if(second.tables.begin(), second.tables.end(),
                                   [&](const GroupTable& t) { return t.name == table.name; });
    const GroupTable none;
    const GroupTable& other = same == second.tables.end() ? none : *same;
    const std::vector<std::int32_t> number = merge_groups(table, other);
    table.face_group = joined(std::move(table.face_group), n_first, other.face_group, n_second, number);
  }
  return out;
}

std::string role_of_name(const std::string& name) {
  const std::vector<std::string> words = words_of(name);
  const auto has = [&](const char* word) { return std::find(words.begin(), words.end(), word) != words.end(); };
  for (std::size_t i = 0; i + 1 < words.size(); ++i)
    if (words[i] == "far" && words[i + 1] == "field") return "farfield";
  if (has("farfield")) return "farfield";
  for (const char* word : {"symmetry", "sym", "symm", "symplane", "symmetryplane"})
    if (has(word)) return "symmetry";
  return "wall";
}

std::string role_of(const FaceLabels& labels, std::size_t group) {
  return labels.group_role.empty() ? role_of_name(labels.group_name[group]) : labels.group_role[group];
}

bool is_outer_role(const std::string& role) { return role == "farfield" || role == "symmetry"; }

}  // namespace st
