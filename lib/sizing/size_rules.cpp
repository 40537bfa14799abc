#include "sizing/size_rules.h"

#include <algorithm>
#include <sstream>

#include "base/error.h"
#include "base/nearest_name.h"
#include "base/text.h"
#include "sizing/size_options.h"

namespace st {
namespace {

/// Text of mixed parts.
template <class... Parts>
std::string text_of(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

[[noreturn]] void fail(const SizeRule& rule, const std::string& what) {
  throw Error(ExitCode::kUsage, text_of(rule.where, ": ", what, "; st-info geometry.hdf --groups lists names"));
}

using Mask = std::vector<std::uint8_t>;

/// What an item of a rule may name, besides numbers.
struct Named {
  const char* key;
  const std::vector<std::string>& names;  ///< of each entity
  const std::vector<EntityGroup>& groups;

  /// For "did you mean".
  std::vector<std::string> all_names() const {
    std::vector<std::string> all = names;
    for (const EntityGroup& g : groups) all.push_back(g.name);
    return all;
  }
};

/// Entities that any item names, by number, range or pattern.
Mask select(const SizeRule& rule, const std::vector<std::string>& wanted, const Named& all) {
  const auto n = static_cast<std::int64_t>(all.names.size());
  Mask chosen(all.names.size(), 0);
  for (const std::string& item : wanted) {
    if (const auto range = as_range(item)) {
      if (range->first < 1 || range->second > n || range->first > range->second)
        fail(rule, text_of(all.key, ": ", item, " does not exist, there are ", n));
      std::fill(chosen.begin() + (range->first - 1), chosen.begin() + range->second, 1);
      continue;
    }
    bool is_used = false;
    for (std::size_t i = 0; i < chosen.size(); ++i)
      if (name_matches(item, all.names[i])) chosen[i] = is_used = true;
    for (const std::int32_t member : find_members(item, all.groups)) chosen[member] = is_used = true;
    if (!is_used) fail(rule, text_of(all.key, ": '", item, "' matches nothing", did_you_mean(item, all.all_names())));
  }
  return chosen;
}

/// [n_faces] 1 where the face's group matches.
std::vector<std::uint8_t> faces_of_groups(const SizeRule& rule, const char* key, const std::string& pattern,
                                          const ModelTables& t) {
  std::vector<std::uint8_t> is_in = find_faces(pattern, t.labels);
  if (is_in.empty())
    fail(rule, text_of(key, ": no group of faces or part matches '", pattern, "'", say_other_kind(pattern, t.labels)));
  return is_in;
}

Mask edges_between(const SizeRule& rule, const ModelTables& t) {
  const std::string &first = rule.selection.between[0], &second = rule.selection.between[1];
  const auto a = faces_of_groups(rule, "between", first, t), b = faces_of_groups(rule, "between", second, t);
  const std::vector<EdgeId> edges = st::edges_between(a, b, t);
  if (edges.empty()) fail(rule, text_of("between: no edge separates '", first, "' and '", second, "'"));
  Mask chosen(t.n_edges(), 0);
  for (const EdgeId e : edges) chosen[e] = 1;
  return chosen;
}

/// What the groups of the names hold: faces, edges and vertices, of parts faces.
struct GroupMembers {
  Mask faces, edges, vertices;
};

GroupMembers members_of_groups(const SizeRule& rule, const ModelTables& t) {
  GroupMembers all{Mask(t.n_faces(), 0), Mask(t.n_edges(), 0), Mask(t.n_vertices(), 0)};
  for (const std::string& pattern : rule.selection.groups) {
    const std::vector<EdgeId> edges = find_members(pattern, t.labels.edge_groups);
    const std::vector<VertexId> vertices = find_members(pattern, t.labels.vertex_groups);
    for (const EdgeId e : edges) all.edges[e] = 1;
    for (const VertexId v : vertices) all.vertices[v] = 1;
    const Mask is_in = find_faces(pattern, t.labels);
    if (is_in.empty() && edges.empty() && vertices.empty())
      fail(rule, text_of("groups: no group or part matches '", pattern, "'", say_other_kind(pattern, t.labels)));
    for (std::size_t f = 0; f < is_in.size(); ++f) all.faces[f] |= is_in[f];
  }
  return all;
}

Mask detected_edges(const SizeRule& rule, const ModelTables& t, std::span<const WingEdge> wing_edges) {
  const std::vector<WingEdgeKind>& kinds = rule.selection.detected;
  Mask chosen(t.n_edges(), 0);
  bool is_any = false;
  for (const WingEdge& w : wing_edges)
    if (std::find(kinds.begin(), kinds.end(), w.kind) != kinds.end()) chosen[w.edge] = is_any = true;
  if (!is_any)
    fail(rule, text_of("no ", name_of(kinds.front()), " found; st-import --check lists what is, or name the edges"));
  return chosen;
}

void keep(const Mask& wanted, Mask& chosen) {
  for (std::size_t i = 0; i < chosen.size(); ++i) chosen[i] = chosen[i] && wanted[i];
}

void add_edges_of(const Mask& faces, const ModelTables& t, Mask& edges) {
  for (FaceId f = 0; f < t.n_faces(); ++f)
    if (faces[f])
      for (const EdgeId e : t.edges_of(f)) edges[e] = 1;
}

std::vector<std::int32_t> ids_of(const Mask& chosen) {
  std::vector<std::int32_t> ids;
  for (std::size_t i = 0; i < chosen.size(); ++i)
    if (chosen[i]) ids.push_back(static_cast<std::int32_t>(i));
  return ids;
}

/// Edges that meet every key, where one of them is of edges: keys of faces stand for the edges of these.
Mask edges_of_all_keys(const SizeRule& rule, const ModelTables& t, std::span<const WingEdge> wing_edges) {
  const SizeSelection& wanted = rule.selection;
  Mask chosen(t.n_edges(), 1);
  if (!wanted.edges.empty()) keep(select(rule, wanted.edges, {"edges", t.edge_name, t.labels.edge_groups}), chosen);
  if (!wanted.between.empty()) keep(edges_between(rule, t), chosen);
  if (!wanted.detected.empty()) keep(detected_edges(rule, t, wing_edges), chosen);
  if (!wanted.faces.empty()) {
    Mask of_faces(t.n_edges(), 0);
    add_edges_of(select(rule, wanted.faces, {"faces", t.labels.face_name, {}}), t, of_faces);
    keep(of_faces, chosen);
  }
  if (!wanted.groups.empty()) {
    GroupMembers members = members_of_groups(rule, t);
    add_edges_of(members.faces, t, members.edges);
    keep(members.edges, chosen);
  }
  return chosen;
}

}  // namespace

std::span<const SizeKey> size_keys() {
  static constexpr SizeKey keys[] = {{"lmin", &SizeRule::lmin},
                                     {"lmax", &SizeRule::lmax},
                                     {"alpha", &SizeRule::alpha_deg, &SizeOptions::kAlpha},
                                     {"chord", &SizeRule::chord},
                                     {"gap_cells", &SizeRule::gap_cells, &SizeOptions::kGapCells},
                                     {"wall_cells", &SizeRule::wall_cells, &SizeOptions::kWallCells},
                                     {"edge_cells", &SizeRule::edge_cells, &SizeOptions::kEdgeCells},
                                     {"max_aspect", &SizeRule::max_aspect, &SizeOptions::kMaxAspect}};
  return keys;
}

bool SizeRule::asks_sizes() const {
  const auto is_set = [&](const SizeKey& key) {
    return std::visit([&](const auto value) { return (this->*value).has_value(); }, key.value);
  };
  return is_sampled || std::ranges::any_of(size_keys(), is_set);
}

bool add_detected(const std::string& word, SizeSelection& selection) {
  if (word != "trailing" && word != "leading") return false;
  if (word == "leading")
    selection.detected.push_back(WingEdgeKind::kLeading);
  else
    selection.detected.insert(selection.detected.end(), {WingEdgeKind::kSharpTrailing, WingEdgeKind::kBluntTrailing});
  return true;
}

RuleTargets find_targets(const SizeRule& rule, const ModelTables& t, std::span<const WingEdge> wing_edges) {
  const SizeSelection& wanted = rule.selection;
  RuleTargets targets;
  if (wanted.empty()) return targets;
  if (wanted.is_of_edges()) {
    targets.edges = ids_of(edges_of_all_keys(rule, t, wing_edges));
  } else if (wanted.faces.empty()) {
    const GroupMembers members = members_of_groups(rule, t);
    targets = {ids_of(members.faces), ids_of(members.edges), ids_of(members.vertices)};
  } else {
    Mask faces = select(rule, wanted.faces, {"faces", t.labels.face_name, {}});
    if (!wanted.groups.empty()) keep(members_of_groups(rule, t).faces, faces);
    targets.faces = ids_of(faces);
  }
  if (targets.faces.empty() && targets.edges.empty() && targets.vertices.empty())
    fail(rule,
         wanted.is_of_edges() ? "no edge meets all keys of its selection" : "no face meets all keys of its selection");
  return targets;
}

std::vector<DeclaredEdge> declared_edges(std::span<const SizeRule> rules, const ModelTables& t,
                                         std::span<const Strip> strips, std::span<const WingEdge> wing_edges) {
  std::vector<DeclaredEdge> declared;
  for (const SizeRule& rule : rules) {
    if (!rule.meaning) continue;
    RuleTargets targets = find_targets(rule, t, wing_edges);
    for (const FaceId f : targets.faces) {
      if (rule.meaning == EdgeMeaning::kNoTrailing) {
        const auto edges = t.edges_of(f);
        targets.edges.insert(targets.edges.end(), edges.begin(), edges.end());
        continue;
      }
      const auto strip = std::ranges::find(strips, f, &Strip::face);
      if (strip == strips.end() || rule.meaning == EdgeMeaning::kLeading)
        fail(rule, text_of(t.face_label(f),
                           " is not the base of a blunt trailing edge; name edges, with edges, between "
                           "or detected"));
      declared.push_back({strip->edges[0], *rule.meaning, f});
    }
    for (const EdgeId e : targets.edges)
      if (!t.edge_is_degenerate[e]) declared.push_back({e, *rule.meaning, kNone});
  }
  return declared;
}

SamplingLimits changed_limits(const SizeRule& rule, SamplingLimits limits, const LengthReference& reference) {
  const auto resolved = [&](const LengthSpec& spec, const char* key) {
    return resolve_length(spec, reference, text_of(rule.where, ": ", key));
  };
  if (rule.lmin) limits.min_length = resolved(*rule.lmin, "lmin"), limits.has_own_min = true;
  const double before = limits.max_along.value_or(limits.max_length);
  if (rule.lmax) limits.max_length = resolved(*rule.lmax, "lmax"), limits.max_along.reset();
  if (rule.max_aspect) {
    limits.max_aspect = *rule.max_aspect;
    limits.max_along = std::max(before, limits.max_length);
    limits.stretches_curve = true;
  }
  if (rule.chord) limits.chord = resolved(*rule.chord, "chord");
  if (rule.alpha_deg) limits.alpha = radians(*rule.alpha_deg);
  if (rule.gap_cells) limits.gap_cells = *rule.gap_cells > 0 ? rule.gap_cells : std::nullopt;
  if (rule.wall_cells) limits.wall_cells = *rule.wall_cells > 0 ? rule.wall_cells : std::nullopt;
  if (rule.edge_cells) limits.edge_cells = *rule.edge_cells > 0 ? rule.edge_cells : std::nullopt;
  // The limit that the rule does not name gives way.
  if (rule.lmax && !rule.lmin) limits.min_length = std::min(limits.min_length, limits.max_length);
  if (rule.lmin && !rule.lmax) limits.max_length = std::max(limits.min_length, limits.max_length);
  if (limits.min_length > limits.max_length)
    throw Error(ExitCode::kUsage, text_of(rule.where, ": lmin ", limits.min_length, " is larger than lmax ",
                                          limits.max_length, "; give lmin at most lmax"));
  return limits;
}

}  // namespace st
