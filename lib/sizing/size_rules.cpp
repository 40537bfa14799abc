#include "sizing/size_rules.h"

#include <fnmatch.h>

#include <algorithm>
#include <charconv>
#include <sstream>

#include "base/error.h"

namespace st {
namespace {

/// Text of mixed parts.
template <class... Parts>
std::string text_of(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

bool matches(const std::string& pattern, const std::string& name) { return fnmatch(pattern.c_str(), name.c_str(), 0) == 0; }

[[noreturn]] void fail(const SizeRule& rule, const std::string& what) {
  throw Error(ExitCode::kUsage, text_of(rule.where, ": ", what, "; st-info geometry.hdf --groups lists names"));
}

/// A 1-based id as text; nullopt: a name.
std::optional<std::int64_t> as_id(const std::string& text) {
  std::int64_t id = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(id) : std::nullopt;
}

/// Ids of entities named by number or pattern.
std::vector<std::int32_t> select(const SizeRule& rule, const char* key, const std::vector<std::string>& wanted,
                                 const std::vector<std::string>& names, std::int32_t n) {
  std::vector<std::int32_t> result;
  for (const std::string& item : wanted) {
    const std::size_t n_before = result.size();
    if (const auto id = as_id(item)) {
      if (*id < 1 || *id > n) fail(rule, text_of(key, ": ", *id, " does not exist, there are ", n));
      result.push_back(static_cast<std::int32_t>(*id - 1));
    } else {
      for (std::size_t i = 0; i < names.size(); ++i)
        if (!names[i].empty() && matches(item, names[i])) result.push_back(static_cast<std::int32_t>(i));
    }
    if (result.size() == n_before) fail(rule, text_of(key, ": '", item, "' matches nothing"));
  }
  return result;
}

/// [n_faces] 1 where the face's group matches.
std::vector<std::uint8_t> faces_of_groups(const SizeRule& rule, const char* key, const std::string& pattern, const ModelTables& t) {
  std::vector<std::uint8_t> is_in = find_faces(pattern, t.group_names());
  if (is_in.empty()) fail(rule, text_of(key, ": no group or part matches '", pattern, "'"));
  return is_in;
}

std::vector<EdgeId> edges_between(const SizeRule& rule, const ModelTables& t) {
  const auto a = faces_of_groups(rule, "between", rule.between[0], t), b = faces_of_groups(rule, "between", rule.between[1], t);
  std::vector<std::int32_t> offsets;
  std::vector<FaceId> faces;
  t.edge_faces(offsets, faces);
  const auto separates = [&](FaceId f, FaceId g) {
    return a[f] && b[g] && (t.face_group[f] != t.face_group[g] || (!b[f] && !a[g]));
  };
  std::vector<EdgeId> result;
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    bool is_between = false;
    for (std::int32_t i = offsets[e]; i < offsets[e + 1]; ++i)
      for (std::int32_t k = offsets[e]; k < offsets[e + 1]; ++k)
        is_between = is_between || (i != k && separates(faces[i], faces[k]));
    if (is_between) result.push_back(e);
  }
  if (result.empty()) fail(rule, text_of("between: no edge separates '", rule.between[0], "' and '", rule.between[1], "'"));
  return result;
}

std::vector<EdgeId> detected_edges(const SizeRule& rule, std::span<const WingEdge> wing_edges) {
  std::vector<EdgeId> result;
  for (const WingEdge& w : wing_edges)
    if (std::find(rule.detected.begin(), rule.detected.end(), w.kind) != rule.detected.end()) result.push_back(w.edge);
  if (result.empty())
    fail(rule, text_of("no ", name_of(rule.detected.front()), " found; st-import --check lists what is, or name the edges"));
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
  targets.faces = select(rule, "faces", rule.faces, t.face_name, t.n_faces());
  for (const std::string& pattern : rule.groups) {
    const auto is_in = faces_of_groups(rule, "groups", pattern, t);
    for (FaceId f = 0; f < t.n_faces(); ++f)
      if (is_in[f]) targets.faces.push_back(f);
  }
  targets.edges = select(rule, "edges", rule.edges, t.edge_name, t.n_edges());
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
  return targets;
}

SamplingLimits changed_limits(const SizeRule& rule, SamplingLimits limits, double diagonal, std::optional<double> unit_in_m) {
  const auto resolved = [&](const LengthSpec& spec, const char* key) {
    return resolve_length(spec, diagonal, unit_in_m, text_of(rule.where, ": ", key));
  };
  if (rule.lmin) limits.min_length = resolved(*rule.lmin, "lmin");
  if (rule.lmax) limits.max_length = resolved(*rule.lmax, "lmax");
  if (rule.chord) limits.chord = resolved(*rule.chord, "chord");
  if (rule.alpha_deg) limits.alpha = radians(*rule.alpha_deg);
  if (rule.gap_cells) limits.gap_cells = *rule.gap_cells > 0 ? rule.gap_cells : std::nullopt;
  if (rule.edge_cells) limits.edge_cells = *rule.edge_cells > 0 ? rule.edge_cells : std::nullopt;
  // The limit that the rule does not name gives way.
  if (rule.lmax && !rule.lmin) limits.min_length = std::min(limits.min_length, limits.max_length);
  if (rule.lmin && !rule.lmax) limits.max_length = std::max(limits.min_length, limits.max_length);
  if (limits.min_length > limits.max_length)
    throw Error(ExitCode::kUsage,
                text_of(rule.where, ": lmin ", limits.min_length, " is larger than lmax ", limits.max_length, "; give lmin at most lmax"));
  return limits;
}

}  // namespace st
