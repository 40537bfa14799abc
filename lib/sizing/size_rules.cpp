#include "sizing/size_rules.h"

#include <fnmatch.h>

#include <algorithm>
#include <charconv>
#include <sstream>

#include "base/error.h"
#include "base/nearest_name.h"

namespace st {
namespace {

/// Text of mixed parts.
template <class... Parts>
std::string text_of(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

bool matches(const std::string& pattern, const std::string& name) {
  return fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

[[noreturn]] void fail(const SizeRule& rule, const std::string& what) {
  throw Error(ExitCode::kUsage, text_of(rule.where, ": ", what, "; st-info geometry.hdf --groups lists names"));
}

/// A 1-based id as text; nullopt: a name.
std::optional<std::int64_t> as_id(const std::string& text) {
  std::int64_t id = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(id) : std::nullopt;
}

/// What an item of a rule may name, besides numbers.
struct Named {
  const char* key;
  const std::vector<std::string>& names;  ///< of each entity
  const std::vector<EntityGroup>& groups;
};

/// Ids of entities named by number or pattern.
std::vector<std::int32_t> select(const SizeRule& rule, const std::vector<std::string>& wanted, const Named& all) {
  const std::size_t n = all.names.size();
  std::vector<std::int32_t> result;
  for (const std::string& item : wanted) {
    const std::size_t n_before = result.size();
    if (const auto id = as_id(item)) {
      if (*id < 1 || *id > static_cast<std::int64_t>(n))
        fail(rule, text_of(all.key, ": ", *id, " does not exist, there are ", n));
      result.push_back(static_cast<std::int32_t>(*id - 1));
    } else {
      for (std::size_t i = 0; i < n; ++i)
        if (!all.names[i].empty() && matches(item, all.names[i])) result.push_back(static_cast<std::int32_t>(i));
      const std::vector<std::int32_t> members = find_members(item, all.groups);
      result.insert(result.end(), members.begin(), members.end());
    }
    if (result.size() == n_before)
      fail(rule, text_of(all.key, ": '", item, "' matches nothing", did_you_mean(item, all.names)));
  }
  return result;
}

/// [n_faces] 1 where the face's group matches.
std::vector<std::uint8_t> faces_of_groups(const SizeRule& rule, const char* key, const std::string& pattern,
                                          const ModelTables& t) {
  std::vector<std::uint8_t> is_in = find_faces(pattern, t.labels);
  if (is_in.empty())
    fail(rule, text_of(key, ": no group of faces or part matches '", pattern, "'", say_other_kind(pattern, t.labels)));
  return is_in;
}

std::vector<EdgeId> edges_between(const SizeRule& rule, const ModelTables& t) {
  const auto a = faces_of_groups(rule, "between", rule.between[0], t),
             b = faces_of_groups(rule, "between", rule.between[1], t);
  std::vector<EdgeId> result = st::edges_between(a, b, t);
  if (result.empty())
    fail(rule, text_of("between: no edge separates '", rule.between[0], "' and '", rule.between[1], "'"));
  return result;
}

/// What the groups of a name hold: faces, edges and vertices, of parts faces.
void add_groups(const SizeRule& rule, const ModelTables& t, RuleTargets& targets) {
  for (const std::string& pattern : rule.groups) {
    const std::vector<EdgeId> edges = find_members(pattern, t.labels.edge_groups);
    const std::vector<VertexId> vertices = find_members(pattern, t.labels.vertex_groups);
    targets.edges.insert(targets.edges.end(), edges.begin(), edges.end());
    targets.vertices.insert(targets.vertices.end(), vertices.begin(), vertices.end());
    const std::vector<std::uint8_t> is_in = find_faces(pattern, t.labels);
    if (is_in.empty() && edges.empty() && vertices.empty())
      fail(rule, text_of("groups: no group or part matches '", pattern, "'", say_other_kind(pattern, t.labels)));
    for (std::size_t f = 0; f < is_in.size(); ++f)
      if (is_in[f]) targets.faces.push_back(static_cast<FaceId>(f));
  }
}

std::vector<EdgeId> detected_edges(const SizeRule& rule, std::span<const WingEdge> wing_edges) {
  std::vector<EdgeId> result;
  for (const WingEdge& w : wing_edges)
    if (std::find(rule.detected.begin(), rule.detected.end(), w.kind) != rule.detected.end()) result.push_back(w.edge);
  if (result.empty())
    fail(rule,
         text_of("no ", name_of(rule.detected.front()), " found; st-import --check lists what is, or name the edges"));
  return result;
}

void sort_unique(std::vector<std::int32_t>& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

}  // namespace

bool add_detected(const std::string& word, SizeRule& rule) {
  if (word != "trailing" && word != "leading") return false;
  if (word == "leading")
    rule.detected.push_back(WingEdgeKind::kLeading);
  else
    rule.detected.insert(rule.detected.end(), {WingEdgeKind::kSharpTrailing, WingEdgeKind::kBluntTrailing});
  return true;
}

RuleTargets find_targets(const SizeRule& rule, const ModelTables& t, std::span<const WingEdge> wing_edges) {
  RuleTargets targets;
  targets.faces = select(rule, rule.faces, {"faces", t.labels.face_name, {}});
  targets.edges = select(rule, rule.edges, {"edges", t.edge_name, t.labels.edge_groups});
  add_groups(rule, t, targets);
  if (!rule.between.empty()) {
    const std::vector<EdgeId> between = edges_between(rule, t);
    targets.edges.insert(targets.edges.end(), between.begin(), between.end());
  }
  if (!rule.detected.empty()) {
    const std::vector<EdgeId> detected = detected_edges(rule, wing_edges);
    targets.edges.insert(targets.edges.end(), detected.begin(), detected.end());
  }
  sort_unique(targets.faces);
  sort_unique(targets.edges);
  sort_unique(targets.vertices);
  return targets;
}

SamplingLimits changed_limits(const SizeRule& rule, SamplingLimits limits, const LengthReference& reference) {
  const auto resolved = [&](const LengthSpec& spec, const char* key) {
    return resolve_length(spec, reference, text_of(rule.where, ": ", key));
  };
  if (rule.lmin) limits.min_length = resolved(*rule.lmin, "lmin");
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
