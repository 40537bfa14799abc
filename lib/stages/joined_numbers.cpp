#include "stages/joined_numbers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "base/error.h"
#include "base/log.h"
#include "base/sort_once.h"
#include "geometry/model/joined_tables.h"

namespace st {
namespace {

constexpr const char* kRemedy = "st-import --composite none keeps them apart";

std::vector<std::string> numbers_of(const std::vector<std::int32_t>& ids) {
  std::vector<std::string> numbers;
  for (const std::int32_t id : ids) numbers.push_back(std::to_string(id + 1));
  return numbers;
}

/// What these `faces` and `edges` alone select.
RuleTargets targets_of(const std::vector<std::string>& faces, const std::vector<std::string>& edges,
                       const SizeRule& rule, const ModelTables& cad) {
  if (faces.empty() && edges.empty()) return {};
  SizeRule own;
  own.where = rule.where;
  own.selection.faces = faces;
  own.selection.edges = edges;
  return find_targets(own, cad);
}

/// Whether a rule names faces or edges, by numbers or names of the CAD.
bool select_any(const std::vector<SizeRule>& rules) {
  return std::ranges::any_of(
      rules, [](const SizeRule& r) { return !r.selection.faces.empty() || !r.selection.edges.empty(); });
}

/// Whether some but not all of `whole` are among `chosen` (ascending).
template <class Whole, class Id>
bool is_part(const Whole& whole, const std::vector<std::int32_t>& chosen, const Id& id_of) {
  const auto n =
      std::ranges::count_if(whole, [&](const auto& one) { return std::ranges::binary_search(chosen, id_of(one)); });
  return n > 0 && static_cast<std::size_t>(n) < whole.size();
}

}  // namespace

std::vector<FaceId> whole_faces(const std::vector<FaceId>& faces, const Composites& composites,
                                const std::string& where) {
  std::vector<FaceId> wanted = faces, whole = faces;
  sort_once(wanted);
  for (std::int32_t i = 0; i < composites.size(); ++i) {
    const std::span<const FaceId> members = composites.members(i);
    const auto is_wanted = [&](FaceId f) { return std::ranges::binary_search(wanted, f); };
    const auto n = std::ranges::count_if(members, is_wanted);
    if (n == 0) continue;
    std::erase_if(whole, [&](FaceId f) { return std::ranges::binary_search(members, f); });
    whole.push_back(members.front());
    if (static_cast<std::size_t>(n) < members.size())
      log_report(fmt::format("  {}: faces {} are joined, all of them are meant; {}", where,
                             fmt::join(numbers_of({members.begin(), members.end()}), ", "), kRemedy));
  }
  sort_once(whole);
  return whole;
}

bool select_parts(const std::vector<SizeRule>& rules, const GeometryArtifact& geometry) {
  if (geometry.composites.empty() || !select_any(rules)) return false;
  const Composites& composites = geometry.composites;
  const JoinedTables joined = join_tables(geometry.cad, composites);
  for (const SizeRule& rule : rules) {
    const std::vector<FaceId> faces = targets_of(rule.selection.faces, {}, rule, geometry.cad).faces;
    for (std::int32_t i = 0; i < composites.size(); ++i)
      if (is_part(composites.members(i), faces, [](FaceId f) { return f; })) return true;
    const std::vector<EdgeId> edges = targets_of({}, rule.selection.edges, rule, geometry.cad).edges;
    for (EdgeId e = 0; e < geometry.cad.n_edges(); ++e)
      if (is_part(joined.pieces_of(e), edges, [](const EdgePiece& p) { return p.edge; })) return true;
    if (std::ranges::any_of(edges, [&](EdgeId e) { return std::ranges::binary_search(composites.joined_edges, e); }))
      return true;
  }
  return false;
}

std::vector<SizeRule> rules_on_joined(std::vector<SizeRule> rules, const GeometryArtifact& geometry) {
  if (geometry.composites.empty() || !select_any(rules)) return rules;
  const JoinedTables joined = join_tables(geometry.cad, geometry.composites);
  std::vector<EdgeId> whole_edge(static_cast<std::size_t>(geometry.cad.n_edges()), kNone);
  for (EdgeId e = 0; e < geometry.cad.n_edges(); ++e)
    for (const EdgePiece& p : joined.pieces_of(e)) whole_edge[static_cast<std::size_t>(p.edge)] = e;
  for (SizeRule& rule : rules) {
    if (!rule.selection.faces.empty())
      rule.selection.faces = numbers_of(
          whole_faces(targets_of(rule.selection.faces, {}, rule, geometry.cad).faces, geometry.composites, rule.where));
    if (rule.selection.edges.empty()) continue;
    std::vector<EdgeId> edges = targets_of({}, rule.selection.edges, rule, geometry.cad).edges;
    for (EdgeId& e : edges) e = whole_edge[static_cast<std::size_t>(e)];
    sort_once(edges);
    rule.selection.edges = numbers_of(edges);
  }
  return rules;
}

bool are_of_cad_faces(const std::vector<double>& face_weight, const Composites& composites) {
  for (std::int32_t i = 0; i < composites.size(); ++i)
    for (const FaceId f : composites.members(i).subspan(1))
      if (static_cast<std::size_t>(f) < face_weight.size() && face_weight[static_cast<std::size_t>(f)] > 0) return true;
  return false;
}

void require_same_composites(const std::string& mesh, const MeshArtifact& old, const std::string& moved,
                             const GeometryArtifact& geometry) {
  std::vector<FaceId> whole(static_cast<std::size_t>(geometry.tables.n_faces()));
  std::iota(whole.begin(), whole.end(), 0);
  for (std::int32_t i = 0; i < geometry.composites.size(); ++i)
    for (const FaceId f : geometry.composites.members(i))
      whole[static_cast<std::size_t>(f)] = geometry.composites.members(i)[0];
  for (std::size_t t = 0; t < old.triangle_cad_face.size(); ++t) {
    const FaceId cad = old.triangle_cad_face[t], face = old.mesh.triangle_face[t];
    if (static_cast<std::size_t>(cad) >= whole.size() || whole[static_cast<std::size_t>(cad)] == face) continue;
    const auto [low, high] = std::minmax({cad, cad == face ? whole[static_cast<std::size_t>(cad)] : face});
    throw Error(ExitCode::kMismatch,
                fmt::format("--moved: {} and {} are not alike: faces {} and {} are joined in one of them; mesh {} with "
                            "st-mesh, or make both with st-import --composite none",
                            mesh, moved, low + 1, high + 1, moved));
  }
}

}  // namespace st
