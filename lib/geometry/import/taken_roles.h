// Groups of a groups file that took faces of a far field or a symmetry plane unawares. Internal to geometry.
#pragma once

#include <string>
#include <vector>

namespace st {

struct FaceLabels;
struct GroupRule;
struct ModelTables;

/// One line for each main group that took faces of a far field, a symmetry plane or an interface and gave them another
/// role, though no rule of it names a role: a box that reaches too far. Lengths in % and boundary conditions would be
/// others. `before`: the labels that apply_groups() met.
std::vector<std::string> find_taken_roles(const std::vector<GroupRule>& rules, const FaceLabels& before,
                                          const ModelTables& tables);

/// Warns of them.
void say_taken_roles(const std::vector<GroupRule>& rules, const FaceLabels& before, const ModelTables& tables);

}  // namespace st
