#include "stages/group_suggestion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/text.h"
#include "features/base_strips.h"
#include "features/bodies.h"
#include "features/round_tails.h"
#include "features/strip.h"
#include "stages/id_ranges.h"

namespace st {

namespace {

std::vector<LiftingSurface> wings_of(const Model& model, const FaceRoles& roles) {
  const std::vector<Strip> strips = find_base_strips(model, find_strips(model));
  const std::vector<WingEdge> edges = find_wing_edges(model, roles, strips);
  std::vector<LiftingSurface> wings = find_lifting_surfaces(model, roles, edges);
  add_round_tails(model, roles, edges, std::vector<std::uint8_t>(static_cast<std::size_t>(model.tables().n_edges())),
                  wings);
  return wings;
}

}  // namespace

std::vector<SuggestedGroup> suggest_groups_of(const Model& model) {
  const ModelTables& t = model.tables();
  FaceRoles roles = face_roles(model);
  if (!is_material_ahead(t, roles)) {  // vanes in a passage: solids have no wing-like holes
    FaceRoles passage = roles;
    passage.is_passage = true;
    const std::vector<LiftingSurface> vanes = wings_of(model, passage);
    const Bodies none{{}, std::vector<std::int32_t>(roles.role.size(), kNone)};
    if (!vanes.empty()) return suggest_groups(t, passage, vanes, none);
  }
  const std::vector<LiftingSurface> wings = wings_of(model, roles);
  return suggest_groups(t, roles, wings, find_bodies(model, roles, wings));
}

std::string groups_file_text(const std::vector<SuggestedGroup>& groups, const ModelTables& tables,
                             const std::string& model) {
  std::string text = fmt::format(
      "# Groups that the shape of {} suggests. Look at them, change them, then: st-import --groups FILE\n"
      "# with the same options otherwise, since other options may give faces other numbers.\n",
      model);
  for (const SuggestedGroup& g : groups) {
    text += fmt::format("\n[[group]]  # {}: {}\nname = \"{}\"\n", counted(g.faces.size(), "face"), g.why, g.name);
    std::vector<std::int32_t> ids;
    for (const FaceId f : g.faces) ids.push_back(f + 1);
    text += fmt::format("faces = [{}]\n", id_ranges(ids, '"'));
    if (g.role != "wall") text += fmt::format("role = \"{}\"\n", g.role);
  }
  std::vector<std::uint8_t> is_in(static_cast<std::size_t>(tables.n_faces()), 0);
  for (const SuggestedGroup& g : groups)
    for (const FaceId f : g.faces) is_in[f] = 1;
  std::vector<std::int32_t> others;
  for (FaceId f = 0; f < tables.n_faces(); ++f)
    if (!is_in[f]) others.push_back(f + 1);
  if (!others.empty()) text += fmt::format("\n# in none of them: faces {}\n", id_ranges(others));
  return text;
}

std::string groups_in_words(const std::vector<SuggestedGroup>& groups, const ModelTables& tables) {
  std::string text;
  std::size_t n = 0;
  for (const SuggestedGroup& g : groups) {
    n += g.faces.size();
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", g.name, g.faces.size());
  }
  return fmt::format("{}; {} of {} faces are in none", text.empty() ? "none" : text + " faces",
                     static_cast<std::size_t>(tables.n_faces()) - n, tables.n_faces());
}

std::string groups_in_words(const FaceLabels& labels) {
  constexpr std::size_t kMost = 16;
  std::vector<std::size_t> n_faces(labels.group_name.size(), 0);
  for (const std::int32_t g : labels.face_group)
    if (g != kNone) ++n_faces[static_cast<std::size_t>(g)];
  std::vector<std::string> words;
  for (std::size_t g = 0; g < n_faces.size(); ++g) {
    const std::string role = g < labels.group_role.size() ? labels.group_role[g] : "wall";
    words.push_back(fmt::format("{} {}{}", labels.group_name[g], counted(n_faces[g], "face"),
                                role == "wall" ? "" : " (" + role + ")"));
  }
  for (const GroupTable& table : labels.tables)
    words.push_back(fmt::format("table {} of {}", table.name, counted(table.group_name.size(), "group")));
  for (const EntityGroup& g : labels.edge_groups)
    words.push_back(fmt::format("{} {}", g.name, counted(g.ids.size(), "edge")));
  for (const EntityGroup& g : labels.vertex_groups)
    words.push_back(fmt::format("{} {}", g.name, counted(g.ids.size(), "vertex", "vertices")));
  const std::size_t n = std::min(words.size(), kMost);
  return fmt::format("{}{}", fmt::join(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(n), ", "),
                     words.size() > n ? fmt::format(" and {} more", words.size() - n) : "");
}

}  // namespace st
