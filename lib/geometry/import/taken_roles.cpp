#include "geometry/import/taken_roles.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/face_labels.h"
#include "base/log.h"
#include "geometry/model/groups.h"
#include "geometry/model/model_tables.h"

namespace st {
namespace {

/// The first rule of the main group of faces, null where none speaks of it or one of them gives it a role.
const GroupRule* rule_without_role(const std::vector<GroupRule>& rules, const std::string& group) {
  const GroupRule* first = nullptr;
  for (const GroupRule& r : rules) {
    if (r.of != EntityDim::kFace || !r.table.empty() || r.name != group) continue;
    if (r.role) return nullptr;
    if (!first) first = &r;
  }
  return first;
}

bool is_of_air(const std::string& role) { return role == "farfield" || role == "symmetry" || role == "interface"; }

}  // namespace

std::vector<std::string> find_taken_roles(const std::vector<GroupRule>& rules, const FaceLabels& before,
                                          const ModelTables& t) {
  std::vector<std::string> lines;
  for (std::size_t g = 0; g < t.labels.group_name.size(); ++g) {
    const GroupRule* rule = rule_without_role(rules, t.labels.group_name[g]);
    const std::string& role_now = t.labels.group_role[g];
    std::string faces;
    for (FaceId f = 0; rule && f < t.n_faces(); ++f) {
      const std::string& role = before.group_role[before.face_group[f]];
      if (t.labels.face_group[f] != static_cast<std::int32_t>(g) || role == role_now || !is_of_air(role)) continue;
      faces += fmt::format("{}{} ({})", faces.empty() ? "" : ", ", t.face_label(f), role);
    }
    if (!faces.empty())
      lines.push_back(fmt::format("{}: group \"{}\" is {} and takes {}; give it a role, or select without these faces",
                                  rule->where, rule->name, role_now, faces));
  }
  return lines;
}

void say_taken_roles(const std::vector<GroupRule>& rules, const FaceLabels& before, const ModelTables& tables) {
  for (const std::string& line : find_taken_roles(rules, before, tables)) log_warning(line);
}

}  // namespace st
