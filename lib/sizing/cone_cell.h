// Where in one cell a cone tells the length: at probes, and where the cell is closest to it. Internal to sizing.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "sizing/cone_kernels.h"
#include "sizing/cones.h"

namespace st {

using Int4 [[gnu::vector_size(16)]] = std::int32_t;  // of a comparison: -1 where it holds

inline bool is_any(Int4 v) {
  std::uint64_t half[2];
  std::memcpy(half, &v, sizeof half);
  return (half[0] | half[1]) != 0;
}

inline Float4 four(float v) { return v - Float4{}; }
inline Float4 min_of(Float4 a, Float4 b) { return a < b ? a : b; }

// The probes of a cell, see cone_kernels.h.
inline constexpr int kProbeGroups = kProbes / 4;
using Lengths = std::array<Float4, kProbeGroups>;

/// Whether lengths are below a share of others at any probe.
inline bool is_below(const Lengths& lengths, float share, const Lengths& others) {
  Int4 is_below{};
  for (int g = 0; g < kProbeGroups; ++g) is_below |= lengths[g] < share * others[g];
  return is_any(is_below);
}

/// Of vectors the numbers in them, which are their elements to the compiler, too.
inline float* numbers(Lengths& lengths) { return reinterpret_cast<float*>(lengths.data()); }
inline const float* numbers(const Lengths& lengths) { return reinterpret_cast<const float*>(lengths.data()); }
template <std::size_t n>
std::int32_t* numbers(std::array<Int4, n>& winners) {
  return reinterpret_cast<std::int32_t*>(winners.data());
}
template <std::size_t n>
const std::int32_t* numbers(const std::array<Int4, n>& winners) {
  return reinterpret_cast<const std::int32_t*>(winners.data());
}

/// The cube of a cell, from the lower corner of the root.
struct ConeCell {
  float c[3];
  float half;

  ConeCell() = default;
  ConeCell(const OctreeView& octree, std::int32_t leaf)
      : half(static_cast<float>(0.5 * octree.cell_edge(octree.leaf_levels[leaf]))) {
    const Vec3 center = octree.leaf_center(leaf) - octree.lo;
    c[0] = static_cast<float>(center.x);
    c[1] = static_cast<float>(center.y);
    c[2] = static_cast<float>(center.z);
  }

  /// As the kernels want it.
  const float* numbers() const { return reinterpret_cast<const float*>(this); }
  /// Of a cone at the probes.
  Lengths lengths(const ConeKernels& kernels, const Cone& cone) const {
    Lengths result;
    kernels.lengths(numbers(), cone.numbers(), st::numbers(result));
    return result;
  }
};
static_assert(sizeof(ConeCell) == 4 * sizeof(float));

}  // namespace st
