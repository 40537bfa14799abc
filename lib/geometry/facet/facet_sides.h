// Sides of facets by their pairs of nodes, however many facets have one.
#pragma once

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "base/lists_by_key.h"
#include "geometry/facet/facet_mesh.h"

namespace st {

/// A side with its nodes in ascending order.
struct FacetSide {
  std::int32_t low, high, triangle;
  bool is_forward;  ///< from the lower node to the higher one
  bool operator<(const FacetSide& o) const { return std::tie(high, triangle) < std::tie(o.high, o.triangle); }
};

/// Of each lower node, by higher node and triangle.
inline ListsByKey<FacetSide> sorted_sides(const std::vector<Corners>& corners, std::size_t n_nodes) {
  ListsByKey<FacetSide> sides(n_nodes, [&](const auto& visit) {
    for (std::size_t i = 0; i < 3 * corners.size(); ++i) {
      const auto [a, b] = std::pair(corners[i / 3][i % 3], corners[i / 3][(i + 1) % 3]);
      visit(std::min(a, b), FacetSide{std::min(a, b), std::max(a, b), static_cast<std::int32_t>(i / 3), a < b});
    }
  });
  for (std::size_t n = 0; n < n_nodes; ++n) std::sort(sides[n].begin(), sides[n].end());
  return sides;
}

/// Calls visit(sides) for each pair of nodes with all sides that it has.
template <class Visit>
void for_each_pair(const ListsByKey<FacetSide>& sides, const Visit& visit) {
  for (std::size_t node = 0; node < sides.n_keys(); ++node) {
    const std::span<const FacetSide> own = sides[node];
    for (std::size_t i = 0, j; i < own.size(); i = j) {
      for (j = i + 1; j < own.size() && own[j].high == own[i].high;) ++j;
      visit(own.subspan(i, j - i));
    }
  }
}

}  // namespace st
