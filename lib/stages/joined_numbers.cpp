#include "stages/joined_numbers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

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

std::vector<SizeRule> rules_on_joined(std::vector<SizeRule> rules, const GeometryArtifact& geometry) {
  if (geometry.composites.empty()) return rules;
  const JoinedTables joined = join_tables(geometry.cad, geometry.composites);
  std::vector<EdgeId> whole_edge(static_cast<std::size_t>(geometry.cad.n_edges()), kNone);
  for (EdgeId e = 0; e < geometry.cad.n_edges(); ++e)
    for (const EdgePiece& p : joined.pieces_of(e)) whole_edge[static_cast<std::size_t>(p.edge)] = e;
  for (SizeRule& rule : rules) {
    if (!rule.faces.empty()) {
      SizeRule own;
      own.where = rule.where;
      own.faces = rule.faces;
      rule.faces = numbers_of(whole_faces(find_targets(own, geometry.cad).faces, geometry.composites, rule.where));
    }
    if (rule.edges.empty()) continue;
    SizeRule own;
    own.where = rule.where;
    own.edges = rule.edges;
    std::vector<EdgeId> edges;
    for (const EdgeId e : find_targets(own, geometry.cad).edges)
      if (whole_edge[static_cast<std::size_t>(e)] != kNone) edges.push_back(whole_edge[static_cast<std::size_t>(e)]);
    if (edges.empty())
      throw Error(ExitCode::kUsage,
                  fmt::format("{}: edges: all of them lie between faces that are joined; {}", rule.where, kRemedy));
    sort_once(edges);
    rule.edges = numbers_of(edges);
  }
  return rules;
}

}  // namespace st
