#include "stages/edit_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "base/error.h"
#include "base/nearest_name.h"
#include "base/text.h"

namespace st {
namespace {

bool has(const std::vector<std::string>& names, const std::string& name) { return std::find(names.begin(), names.end(), name) != names.end(); }

/// [n_faces] 1: the group, part or face has this name; empty: none has.
std::vector<std::uint8_t> faces_named(const std::string& name, const ModelTables& t) {
  std::vector<std::uint8_t> is_in = find_faces(name, t.group_names());
  if (!is_in.empty()) return is_in;
  is_in.resize(t.n_faces());
  for (FaceId f = 0; f < t.n_faces(); ++f)
    is_in[f] = name_matches(name, t.face_name[f]);
  return std::find(is_in.begin(), is_in.end(), 1) == is_in.end() ? std::vector<std::uint8_t>() : is_in;
}

std::vector<std::string> all_names(const ModelTables& t) {
  std::vector<std::string> names = t.group_name;
  for (const GroupTable& table : t.labels.tables) names.insert(names.end(), table.group_name.begin(), table.group_name.end());
  for (const std::vector<std::string>* more : {&t.labels.part_name, &t.labels.part_path, &t.face_name})
    names.insert(names.end(), more->begin(), more->end());
  return names;
}

void select_item(const std::string& item, const ModelTables& t, const std::string& option, std::vector<std::uint8_t>& chosen) {
  if (const auto range = as_range(item)) {
    if (range->first < 1 || range->second > t.n_faces() || range->first > range->second)
      throw Error(ExitCode::kUsage, fmt::format("{} '{}': there are faces 1 to {}", option, item, t.n_faces()));
    std::fill(chosen.begin() + (range->first - 1), chosen.begin() + range->second, 1);
    return;
  }
  const std::vector<std::uint8_t> named = faces_named(item, t);
  if (named.empty()) {
    const std::string nearest = nearest_name(item, all_names(t));
    throw Error(ExitCode::kUsage, fmt::format("{} '{}': no group, part or face has this name{}; st-info --groups lists them", option, item,
                                              nearest.empty() ? "" : ", did you mean '" + nearest + "'"));
  }
  for (std::size_t f = 0; f < named.size(); ++f) chosen[f] |= named[f];
}

/// Renames the groups that are not to become one with those of `first`.
void rename_groups(const std::vector<std::string>& first_name, const std::vector<std::string>& first_role, const std::string& prefix,
                   const std::vector<std::string>& join, std::vector<std::string>& names, const std::vector<std::string>& roles) {
  const auto is_joined = [&](const std::string& name) {
    return std::any_of(join.begin(), join.end(), [&](const std::string& j) { return name_matches(j, name); });
  };
  std::vector<std::string> taken = first_name;
  taken.insert(taken.end(), names.begin(), names.end());
  for (std::size_t g = 0; g < names.size(); ++g) {
    const auto same = std::find(first_name.begin(), first_name.end(), names[g]);
    if (same == first_name.end()) continue;
    if (!is_joined(names[g])) {
      names[g] = unique_path(prefix + "/" + names[g], taken);
      taken.push_back(names[g]);
    } else if (const std::string& role = first_role[same - first_name.begin()]; role != roles[g]) {
      throw Error(ExitCode::kMismatch, fmt::format("--join: the group '{}' has the role {} in one input and {} in '{}'; give them one role "
                                                   "(st-import --groups), or leave it out of --join",
                                                   names[g], role, roles[g], prefix));
    }
  }
}

}  // namespace

std::vector<std::string> split_names(const std::string& text) {
  std::vector<std::string> names;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find(',', from), text.size());
    if (const std::string name = trimmed(std::string_view(text).substr(from, to - from)); !name.empty()) names.push_back(name);
    from = to + 1;
  }
  return names;
}

std::vector<FaceId> select_faces(const std::string& names, const ModelTables& t, const std::string& option) {
  std::vector<std::uint8_t> chosen(t.n_faces(), 0);
  const bool is_one_name = names.find(',') != std::string::npos && !faces_named(names, t).empty();
  const std::vector<std::string> items = is_one_name ? std::vector{names} : split_names(names);
  if (items.empty()) throw Error(ExitCode::kUsage, fmt::format("{} '{}': names nothing; write a group, a part, or faces such as 17,30-40", option, names));
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
    throw Error(ExitCode::kUsage, fmt::format("--as '{}': {} names for {} geometries; name each", given, names.size(), paths.size()));
  std::vector<std::string> unique;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    std::string name = names.empty() ? std::filesystem::path(paths[i]).stem().string() : names[i];
    for (const InputRef& input : inputs[i].header.inputs)
      if (names.empty() && name == "geometry" && input.role == "cad") name = std::filesystem::path(input.name).stem().string();
    unique.push_back(unique_path(name, unique));
  }
  return unique;
}

void label_input(const std::string& name, ModelTables& t) {
  std::vector<GroupTable>& tables = t.labels.tables;
  auto table = std::find_if(tables.begin(), tables.end(), [](const GroupTable& x) { return x.name == kInputTable; });
  if (table == tables.end()) table = tables.insert(table, {kInputTable, {}, {}, {}, std::vector<std::int32_t>(t.n_faces(), kNone)});
  if (std::find(table->face_group.begin(), table->face_group.end(), kNone) == table->face_group.end()) return;
  const auto group = static_cast<std::int32_t>(table->group_name.size());
  table->group_name.push_back(unique_path(name, table->group_name));
  table->group_role.push_back("wall");
  table->group_attributes.push_back("{}");
  std::replace(table->face_group.begin(), table->face_group.end(), kNone, group);
}

void keep_names_apart(const ModelTables& first, const std::string& name, const std::vector<std::string>& join, ModelTables& second) {
  rename_groups(first.group_name, first.group_role, name, join, second.group_name, second.group_role);
  for (GroupTable& table : second.labels.tables)
    for (const GroupTable& other : first.labels.tables)
      if (other.name == table.name) rename_groups(other.group_name, other.group_role, name, join, table.group_name, table.group_role);
  std::vector<std::string> taken = first.labels.part_path;
  for (std::string& path : second.labels.part_path) {
    if (has(first.labels.part_path, path)) path = unique_path(name + "/" + path, taken);
    taken.push_back(path);
  }
}

}  // namespace st
