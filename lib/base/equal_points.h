// Nodes of triangles at one place.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace st {

/// Of all bits of the coordinates; equal places have equal ones, those with -0 for 0, too.
std::uint64_t hash_of_place(Vec3 x);

/// Nodes with equal coordinates `x` become the lowest of them in all corners of triangles. -0 equals 0. Files with
/// numbered nodes (OBJ, PLY, MSH ...) have such where faces of their program end. Linear.
void join_equal_points(std::span<const Vec3> x, std::vector<std::array<std::int32_t, 3>>& corners);

}  // namespace st
