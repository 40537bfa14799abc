// The triangulation of a closed polygon in space that has the least area (Barequet and Sharir 1995, Liepa 2003).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/vec.h"

namespace st {

/// Of all triangulations of a polygon's nodes the one with the least sum of areas, on a surface, and of costs of its
/// sides. `x`, `id` [n]: places and ids of the nodes. `middle`, `side_cost` [n*n], at i*n + j with i < j: the middle of
/// the side between two nodes, on the surface, and its cost. Returns triples of places in the polygon; none where every
/// triangulation has a triangle with one id twice. The cost is cubic.
std::vector<std::array<std::size_t, 3>> triangulate_least_area(std::vector<Vec3> x, std::vector<std::int32_t> id,
                                                               std::vector<Vec3> middle, std::vector<double> side_cost);

/// Calls take(i, j, k) for the triangles of a polygon of n places: that at the side from 0 to n - 1, whose third corner
/// is apex(i, k), then those at its other two sides, and so on.
template <class Apex, class Take>
void for_each_split(std::size_t n, const Apex& apex, const Take& take) {
  std::vector<std::pair<std::size_t, std::size_t>> open = {{0, n - 1}};
  while (!open.empty()) {
    const auto [i, k] = open.back();
    open.pop_back();
    if (k - i < 2) continue;
    const std::size_t j = apex(i, k);
    take(i, j, k);
    open.push_back({i, j});
    open.push_back({j, k});
  }
}

}  // namespace st
