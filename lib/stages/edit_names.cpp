#include "stages/edit_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/error.h"
#include "base/log.h"
#include "base/near_face_name.h"
#include "base/nearest_name.h"
#include "base/text.h"
#include "io/file/json_text.h"

namespace st {
namespace {

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// [n_faces] 1: the group, part or face has this name; empty: none has.
std::vector<std::uint8_t> faces_named(const std::string& name, const ModelTables& t) {
  std::vector<std::uint8_t> is_in = find_faces(name, t.labels);
  if (!is_in.empty()) return is_in;
  is_in.resize(t.n_faces());
  for (FaceId f = 0; f < t.n_faces(); ++f) is_in[f] = name_matches(name, t.labels.face_name[f]);
  return std::find(is_in.begin(), is_in.end(), 1) == is_in.end() ? std::vector<std::uint8_t>() : is_in;
}

void select_item(const std::string& item, const ModelTables& t, const std::string& option,
                 std::vector<std::uint8_t>& chosen) {
  if (const auto range = as_range(item)) {
    if (range->first < 1 || range->second > t.n_faces() || range->first > range->second)
      throw Error(ExitCode::kUsage,
                  fmt::format("{} '{}': no such face; the model has faces 1 to {}", option, item, t.n_faces()));
    std::fill(chosen.begin() + (range->first - 1), chosen.begin() + range->second, 1);
    return;
  }
  const std::vector<std::uint8_t> named = faces_named(item, t);
  if (named.empty()) {
    throw Error(ExitCode::kUsage,
                fmt::format("{} '{}': no group, part or face has this name{}; st-info --groups lists them", option,
                            item, say_other_name(item, t.labels)));
  }
  for (std::size_t f = 0; f < named.size(); ++f) chosen[f] |= named[f];
}

/// Names of the groups of one table ("": the main one) and what they are groups of, in words.
std::map<std::string, std::string> groups_of(const std::string& table, const ModelTables& t) {
  std::map<std::string, std::string> kinds;
  const auto add = [&](const auto& of) {
    for (std::size_t g = 0; g < of.group_name.size(); ++g)
      kinds[of.group_name[g]] = "faces with the role " + of.group_role[g];
  };
  if (table.empty()) add(t.labels);
  for (const GroupTable& other : t.labels.tables)
    if (other.name == table) add(other);
  for (const EntityGroup& g : t.labels.edge_groups)
    if (g.table == table) kinds[g.name] = "edges";
  for (const EntityGroup& g : t.labels.vertex_groups)
    if (g.table == table) kinds[g.name] = "vertices";
  return kinds;
}

/// New names for the groups of `second` whose name a group of `first` has, unless they are to become one with it.
std::map<std::string, std::string> new_names(const std::map<std::string, std::string>& first,
                                             const std::map<std::string, std::string>& second,
                                             const std::string& prefix, const std::vector<std::string>& join) {
  std::vector<std::string> taken;
  for (const auto* groups : {&first, &second})
    for (const auto& [name, kind] : *groups) taken.push_back(name);
  std::map<std::string, std::string> renamed;
  for (const auto& group : second) {
    const std::string &name = group.first, &kind = group.second;
    const auto same = first.find(name);
    if (same == first.end()) continue;
    if (std::none_of(join.begin(), join.end(), [&](const std::string& j) { return name_matches(j, name); })) {
      taken.push_back(renamed[name] = unique_path(prefix + "/" + name, taken));
    } else if (same->second != kind) {
      throw Error(ExitCode::kMismatch,
                  fmt::format("--join: the group '{}' holds {} in one input and {} in '{}'; make them equal "
                              "(st-import --groups), or leave it out of --join",
                              name, same->second, kind, prefix));
    }
  }
  return renamed;
}

void rename_groups(const std::string& table, const std::map<std::string, std::string>& renamed, ModelTables& t) {
  const auto rename = [&](std::string& name) {
    if (const auto found = renamed.find(name); found != renamed.end()) name = found->second;
  };
  if (table.empty()) std::for_each(t.labels.group_name.begin(), t.labels.group_name.end(), rename);
  for (GroupTable& other : t.labels.tables)
    if (other.name == table) std::for_each(other.group_name.begin(), other.group_name.end(), rename);
  for (std::vector<EntityGroup>* groups : {&t.labels.edge_groups, &t.labels.vertex_groups})
    for (EntityGroup& g : *groups)
      if (g.table == table) rename(g.name);
}

/// Names of the tables in which there are groups, the main one as "".
std::vector<std::string> table_names(const FaceLabels& labels) {
  std::vector<std::string> names = {""};
  const auto add = [&](const std::string& name) {
    if (!has(names, name)) names.push_back(name);
  };
  for (const GroupTable& table : labels.tables) add(table.name);
  for (const EntityGroup& g : labels.edge_groups) add(g.table);
  for (const EntityGroup& g : labels.vertex_groups) add(g.table);
  return names;
}

/// The attribute `tolerance`, a length, scaled; other attributes stay.
void scale_tolerance(double scale, std::string& attributes) {
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(attributes, nullptr, false);
  if (!json.is_object() || !json.contains("tolerance") || !json["tolerance"].is_number()) return;
  json["tolerance"] = scale * json["tolerance"].get<double>();
  attributes = json_text(json);
}

}  // namespace

std::vector<std::string> split_names(const std::string& text) {
  std::vector<std::string> names;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find(',', from), text.size());
    if (const std::string name = trimmed(std::string_view(text).substr(from, to - from)); !name.empty())
      names.push_back(name);
    from = to + 1;
  }
  return names;
}

std::vector<FaceId> select_faces(const std::string& names, const ModelTables& t, const std::string& option) {
  std::vector<std::uint8_t> chosen(t.n_faces(), 0);
  const bool is_one_name = names.find(',') != std::string::npos && !faces_named(names, t).empty();
  const std::vector<std::string> items = is_one_name ? std::vector{names} : split_names(names);
  if (items.empty())
    throw Error(ExitCode::kUsage,
                fmt::format("{} '{}': nothing named; write a group, a part, or faces such as 17,30-40", option, names));
  for (const std::string& item : items) select_item(item, t, option, chosen);
  std::vector<FaceId> faces;
  for (FaceId f = 0; f < t.n_faces(); ++f)
    if (chosen[f]) faces.push_back(f);
  return faces;
}

std::vector<std::string> input_names(const std::string& given, const std::vector<std::string>& paths,
                                     const std::vector<GeometryArtifact>& inputs) {
  const std::vector<std::string> names = split_names(given);
  if (!names.empty() && names.size() != paths.size())
    throw Error(ExitCode::kUsage, fmt::format("--as '{}': {} names for {} geometries; give one name for each", given,
                                              names.size(), paths.size()));
  std::vector<std::string> unique;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    std::string name = names.empty() ? std::filesystem::path(paths[i]).stem().string() : names[i];
    for (const InputRef& input : inputs[i].header.inputs)
      if (names.empty() && name == "geometry" && input.role == "cad")
        name = std::filesystem::path(input.name).stem().string();
    unique.push_back(unique_path(name, unique));
  }
  return unique;
}

void label_input(const std::string& name, ModelTables& t) {
  std::vector<GroupTable>& tables = t.labels.tables;
  auto table = std::find_if(tables.begin(), tables.end(), [](const GroupTable& x) { return x.name == kInputTable; });
  if (table == tables.end())
    table = tables.insert(table, {kInputTable, {}, {}, {}, std::vector<std::int32_t>(t.n_faces(), kNone)});
  if (std::find(table->face_group.begin(), table->face_group.end(), kNone) == table->face_group.end()) return;
  const auto group = static_cast<std::int32_t>(table->group_name.size());
  table->group_name.push_back(unique_path(name, table->group_name));
  table->group_role.push_back("wall");
  table->group_attributes.push_back("{}");
  std::replace(table->face_group.begin(), table->face_group.end(), kNone, group);
}

void require_join_names(const std::vector<std::string>& join, const std::vector<GeometryArtifact>& inputs) {
  for (const std::string& item : join) {
    std::vector<std::string> all;
    int n_inputs = 0;
    for (const GeometryArtifact& input : inputs) {
      bool has_it = false;
      for (const std::string& table : table_names(input.tables.labels))
        for (const auto& [name, kind] : groups_of(table, input.tables)) {
          all.push_back(name);
          has_it = has_it || name_matches(item, name);
        }
      n_inputs += has_it;
    }
    const bool is_pattern = item.find_first_of("*?[") != std::string::npos;
    if (n_inputs == 0 && !is_pattern)
      throw Error(ExitCode::kUsage, fmt::format("--join '{}': no group of the inputs has this name{}; st-info --groups "
                                                "lists them",
                                                item, did_you_mean(item, all)));
    if (n_inputs < 2)
      log_warning(fmt::format("--join '{}': {} input has such a group; nothing is joined", item,
                              n_inputs == 0 ? "no" : "only one"));
  }
}

void keep_names_apart(const ModelTables& first, const std::string& name, const std::vector<std::string>& join,
                      ModelTables& second) {
  for (const std::string& table : table_names(second.labels))
    rename_groups(table, new_names(groups_of(table, first), groups_of(table, second), name, join), second);
  std::vector<std::string> taken = first.labels.part_path;
  for (std::string& path : second.labels.part_path) {
    if (has(first.labels.part_path, path)) path = unique_path(name + "/" + path, taken);
    taken.push_back(path);
  }
}

void scale_tolerances(double scale, FaceLabels& labels) {
  for (std::string& attributes : labels.group_attributes) scale_tolerance(scale, attributes);
  for (GroupTable& table : labels.tables)
    for (std::string& attributes : table.group_attributes) scale_tolerance(scale, attributes);
  for (std::vector<EntityGroup>* groups : {&labels.edge_groups, &labels.vertex_groups})
    for (EntityGroup& g : *groups) scale_tolerance(scale, g.attributes);
}

}  // namespace st
