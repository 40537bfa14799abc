// The triangulation of a closed polygon in space that has the least area (Barequet and Sharir 1995, Liepa 2003).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace st {

/// Of all triangulations of a polygon's nodes the one with the least sum of areas, on a surface, and of costs of its
/// sides. `x`, `id` [n]: places and ids of the nodes. `middle`, `side_cost` [n*n], at i*n + j with i < j: the middle of
/// the side between two nodes, on the surface, and its cost. Returns triples of places in the polygon; none where every
/// triangulation has a triangle with one id twice. The cost is cubic.
std::vector<std::array<std::size_t, 3>> triangulate_least_area(std::vector<Vec3> x, std::vector<std::int32_t> id,
                                                               std::vector<Vec3> middle, std::vector<double> side_cost);

}  // namespace st
