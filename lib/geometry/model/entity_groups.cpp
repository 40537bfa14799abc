#include "geometry/model/entity_groups.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "geometry/model/group_selection.h"

namespace st {
namespace {

using Mask = GroupSelection::Mask;

std::string plural(EntityDim of) {
  return of == EntityDim::kFace ? "faces" : of == EntityDim::kEdge ? "edges" : "vertices";
}

/// Faces of the groups or parts of these names, [n_faces]; an item without faces goes to `other`, which says whether it
/// can use it.
template <class Other>
std::vector<std::uint8_t> faces_of(const GroupRule& rule, const char* key, const std::vector<std::string>& items,
                                   const ModelTables& t, const Other& other) {
  std::vector<std::uint8_t> all(t.n_faces(), 0);
  for (const std::string& item : items) {
    const std::vector<std::uint8_t> own = find_faces(item, t.labels);
    for (std::size_t f = 0; f < own.size(); ++f) all[f] |= own[f];
    if (!other(item) && own.empty() && !rule.is_optional)
      fail_group(rule, std::string(key) + ": no group or part matches '" + item + "'" + say_other_kind(item, t.labels) +
                           "; st-info geometry.hdf --groups lists names");
  }
  return all;
}

std::vector<std::uint8_t> faces_of(const GroupRule& rule, const char* key, const std::vector<std::string>& items,
                                   const ModelTables& t) {
  return faces_of(rule, key, items, t, [](const std::string&) { return false; });
}

/// Edges of these faces, poles left out.
Mask edges_of(const std::vector<std::uint8_t>& faces, const ModelTables& t) {
  Mask wanted(t.n_edges(), 0);
  for (FaceId f = 0; f < t.n_faces(); ++f)
    if (faces[f])
      for (const EdgeId e : t.edges_of(f)) wanted[e] = !t.edge_is_degenerate[e];
  return wanted;
}

/// Of the edges of the faces of `rim` those with a face outside, or none beyond.
Mask outline(const GroupRule& rule, const ModelTables& t) {
  const std::vector<std::uint8_t> faces = faces_of(rule, "rim", rule.selection.rim, t);
  std::vector<int> n_uses(t.n_edges(), 0), n_inside(t.n_edges(), 0);
  for (FaceId f = 0; f < t.n_faces(); ++f)
    for (const CoedgeId c : t.coedges(f)) {
      ++n_uses[t.coedge_edge[c]];
      n_inside[t.coedge_edge[c]] += faces[f];
    }
  Mask wanted = edges_of(faces, t);
  for (EdgeId e = 0; e < t.n_edges(); ++e) wanted[e] = wanted[e] && (n_uses[e] > n_inside[e] || n_uses[e] == 1);
  if (std::find(wanted.begin(), wanted.end(), 1) == wanted.end() && !rule.is_optional)
    fail_group(rule, "rim: these faces are closed and have no outline; select fewer faces, or use 'on'");
  return wanted;
}

Mask mask_between(const GroupRule& rule, const ModelTables& t) {
  const std::string &first = rule.selection.between[0], &second = rule.selection.between[1];
  Mask wanted(t.n_edges(), 0);
  const std::vector<std::uint8_t> a = faces_of(rule, "between", {first}, t), b = faces_of(rule, "between", {second}, t);
  const std::vector<EdgeId> edges = edges_between(a, b, t);
  if (edges.empty() && !rule.is_optional)
    fail_group(rule, "between: '" + first + "' and '" + second +
                         "' have no common edge; faces that only touch, such as those of two parts, have none");
  for (const EdgeId e : edges) wanted[e] = 1;
  return wanted;
}

Mask select_edges(const GroupRule& rule, const ModelTables& t, std::span<const Box3> edge_box) {
  const GroupCriteria& wanted = rule.selection;
  GroupSelection s(rule, t, t.n_edges());
  s.select_items("edges", wanted.edges, t.edge_name);
  if (!wanted.between.empty()) s.keep(mask_between(rule, t));
  if (!wanted.rim.empty()) s.keep(outline(rule, t));
  if (!wanted.on.empty()) s.keep(edges_of(faces_of(rule, "on", wanted.on, t), t));
  s.select_boxes(edge_box, t.edge_tolerance);
  if (s.has_selection()) return s.take("no edge matches its selection");
  s.keep([&](EdgeId e) { return t.edge_name[e] == rule.name; });
  return s.take("no edge has this name");
}

/// Vertices of the faces, edges of groups of the names of `on`.
Mask vertices_on(const GroupRule& rule, const ModelTables& t) {
  Mask of_edges(t.n_edges(), 0);
  const auto add_edges = [&](const std::string& item) {
    const std::vector<EdgeId> edges = find_members(item, t.labels.edge_groups);
    for (const EdgeId e : edges) of_edges[e] = 1;
    return !edges.empty();
  };
  const Mask of_faces = edges_of(faces_of(rule, "on", rule.selection.on, t, add_edges), t);
  Mask wanted(t.n_vertices(), 0);
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    if (of_edges[e] || of_faces[e]) wanted[t.edge_vertices[2 * e]] = wanted[t.edge_vertices[2 * e + 1]] = 1;
  return wanted;
}

Mask select_vertices(const GroupRule& rule, const ModelTables& t) {
  GroupSelection s(rule, t, t.n_vertices());
  s.select_items("vertices", rule.selection.vertices, {});
  if (!rule.selection.on.empty()) s.keep(vertices_on(rule, t));
  std::vector<Box3> box(t.n_vertices());
  for (VertexId v = 0; v < t.n_vertices(); ++v) box[v].add(t.vertex_xyz[v]);
  s.select_boxes(box, t.vertex_tolerance);
  if (!s.has_selection()) fail_group(rule, "vertices have no names; give vertices, on, inside or touching");
  return s.take("no vertex matches its selection");
}

/// Puts the entities of one kind into their groups.
class EntityGrouper {
 public:
  EntityGrouper(EntityDim of, ModelTables& t)
      : of_(of), t_(t), groups_(of == EntityDim::kEdge ? t.labels.edge_groups : t.labels.vertex_groups) {}

  void add(const GroupRule& rule, const Mask& chosen) {
    const std::size_t g = group_of(rule);
    describe(g, rule);
    for (std::size_t i = 0; i < chosen.size(); ++i)
      if (chosen[i]) add_member(g, rule, static_cast<std::int32_t>(i));
  }

  /// Ids in order; groups without any go to `empty`.
  void finish(std::vector<EmptyGroup>& empty) {
    for (EntityGroup& g : groups_) {
      std::sort(g.ids.begin(), g.ids.end());
      if (g.ids.empty()) empty.push_back({g.name, of_});
    }
    std::erase_if(groups_, [](const EntityGroup& g) { return g.ids.empty(); });
  }

 private:
  std::size_t group_of(const GroupRule& rule) {
    const auto is_same = [&](const EntityGroup& g) { return g.name == rule.name && g.table == rule.table; };
    const auto it = std::find_if(groups_.begin(), groups_.end(), is_same);
    if (it != groups_.end()) return it - groups_.begin();
    require_free_name(rule);
    groups_.push_back({rule.name, rule.table, "{}", {}});
    first_.push_back(&rule);
    attributes_by_.push_back(nullptr);
    return groups_.size() - 1;
  }

  /// In a table a name stands for one group.
  void require_free_name(const GroupRule& rule) const {
    const auto refuse = [&](EntityDim other) {
      fail_group(rule, "the table has a group of " + plural(other) + " of this name already; give the " + plural(of_) +
                           " another name");
    };
    const auto has = [&](const std::vector<std::string>& names) {
      return std::find(names.begin(), names.end(), rule.name) != names.end();
    };
    if (rule.table.empty() && has(t_.labels.group_name)) refuse(EntityDim::kFace);
    for (const GroupTable& table : t_.labels.tables)
      if (table.name == rule.table && has(table.group_name)) refuse(EntityDim::kFace);
    if (of_ == EntityDim::kEdge) return;
    for (const EntityGroup& g : t_.labels.edge_groups)
      if (g.name == rule.name && g.table == rule.table) refuse(EntityDim::kEdge);
  }

  void describe(std::size_t g, const GroupRule& rule) {
    if (rule.attributes == "{}") return;
    const GroupRule* const by = attributes_by_[g];
    if (by && rule.attributes != groups_[g].attributes)
      fail_group(rule, "has different attributes from those at " + by->where + "; give them once");
    groups_[g].attributes = rule.attributes;
    attributes_by_[g] = &rule;
  }

  void add_member(std::size_t g, const GroupRule& rule, std::int32_t id) {
    const auto [owner, is_new] = owner_.emplace(std::pair(rule.table, id), g);
    if (is_new) groups_[g].ids.push_back(id);
    if (owner->second == g) return;
    const std::string label = of_ == EntityDim::kEdge ? t_.edge_label(id) : "vertex " + std::to_string(id + 1),
                      other = "group \"" + groups_[owner->second].name + "\" (" + first_[owner->second]->where + ")";
    fail_group(rule, label + " is already in " + other + "; an edge or vertex may be in one group of a table");
  }

  EntityDim of_;
  ModelTables& t_;
  std::vector<EntityGroup>& groups_;
  std::vector<const GroupRule*> first_, attributes_by_;                // [groups] for messages
  std::map<std::pair<std::string, std::int32_t>, std::size_t> owner_;  // of each entity in each table
};

}  // namespace

void apply_entity_groups(EntityDim of, const std::vector<GroupRule>& rules, ModelTables& t,
                         std::span<const Box3> edge_box, std::vector<EmptyGroup>& empty) {
  EntityGrouper grouper(of, t);
  for (const GroupRule& rule : rules)
    if (rule.of == of)
      grouper.add(rule, of == EntityDim::kEdge ? select_edges(rule, t, edge_box) : select_vertices(rule, t));
  grouper.finish(empty);
}

}  // namespace st
