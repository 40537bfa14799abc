#include "geometry/facet/facet_flaps.h"

#include <algorithm>

namespace st {
namespace {

using NodePair = std::pair<std::int32_t, std::int32_t>;

NodePair side_of(const Corners& c, int k) { return std::minmax({c[k], c[(k + 1) % 3]}); }

bool are_opposed(const Corners& a, const Corners& b) {
  const auto at = std::ranges::find(b, a[0]) - b.begin();
  return b[(at + 1) % 3] == a[2];
}

}  // namespace

std::vector<TwinFacets> find_flaps(const std::vector<Corners>& corners, const std::vector<TwinFacets>& pairs) {
  if (pairs.empty()) return {};
  std::map<NodePair, std::vector<std::int32_t>> others;  // facets at the sides of pairs, but those of pairs
  std::map<NodePair, int> n_pairs;
  std::vector<std::uint8_t> is_in_pair(corners.size(), 0);
  for (const auto& [a, b] : pairs) {
    is_in_pair[a] = is_in_pair[b] = 1;
    for (int k = 0; k < 3; ++k) ++n_pairs[side_of(corners[a], k)];
  }
  for (std::size_t t = 0; t < corners.size(); ++t)
    for (int k = 0; k < 3; ++k)
      if (!is_in_pair[t] && n_pairs.contains(side_of(corners[t], k)))
        others[side_of(corners[t], k)].push_back(static_cast<std::int32_t>(t));
  std::vector<TwinFacets> flaps;
  for (const auto& [a, b] : pairs) {
    int n_free = 0, n_hanging = 0;
    for (int k = 0; k < 3; ++k) {
      const NodePair side = side_of(corners[a], k);
      if (n_pairs[side] != 1) continue;
      const auto at = others.find(side);
      n_free += at == others.end();
      n_hanging += at != others.end() && at->second.size() == 2;
    }
    if (n_free > 0 && n_hanging > 0 && n_free + n_hanging == 3 && are_opposed(corners[a], corners[b]))
      flaps.push_back({a, b});
  }
  return flaps;
}

}  // namespace st
