// What follows from the neighbours of a patch's triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/shape/chart_topology.h"

namespace st {

/// As find_topology(x, corners). `neighbours`: [n_triangles] those of find_neighbours(corners).
PatchTopology find_topology(std::span<const Vec3> x, std::span<const Corners> corners,
                            std::span<const Corners> neighbours);

/// [3 n_triangles] for corner k of triangle t, at 3 t + k, the number of its fan: triangles around a node that hang
/// together across sides. Numbers by the lowest corner. `neighbours`: those of find_neighbours(corners), or kNone on
/// both sides of what parts fans.
std::vector<std::int32_t> find_fans(std::span<const Corners> corners, std::span<const Corners> neighbours);

}  // namespace st
