// Polygons of mesh files as triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace st {

/// Adds the triangles of a polygon of nodes that exist, turned as it is; the shortest diagonal that lies inside is cut
/// first. Dented polygons are right where they are flat. Corners that repeat the one before are passed over; less than
/// three corners add nothing. Takes the third power of the number of corners at worst, the square for most.
void split_polygon(const std::vector<Vec3>& node_xyz, std::span<const std::int64_t> corner,
                   std::vector<std::array<std::int64_t, 3>>& triangles);

}  // namespace st
