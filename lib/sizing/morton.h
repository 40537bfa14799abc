// Morton (Z-order) keys of octree cells: 20 bits per axis, interleaved, x lowest.
#pragma once

#include <cstdint>

namespace st {

/// Deepest level: the root's edge is cut into 2^kMaxLevel parts.
inline constexpr int kMaxLevel = 20;
inline constexpr std::uint32_t kCoordinateEnd = 1u << kMaxLevel;

/// Integer position on the grid of the deepest level, each in [0, 2^20).
struct GridPoint {
  std::uint32_t x = 0, y = 0, z = 0;
};

namespace morton {

inline constexpr std::uint64_t kMaskX = 0x1249249249249249ull;  // bits 0, 3, 6 ... 60
inline constexpr std::uint64_t kMaskY = kMaskX << 1, kMaskZ = kMaskX << 2;

/// Spreads the low 21 bits to every third bit.
inline std::uint64_t spread(std::uint64_t v) {
  v = (v | v << 32) & 0x001f00000000ffffull;
  v = (v | v << 16) & 0x001f0000ff0000ffull;
  v = (v | v << 8) & 0x100f00f00f00f00full;
  v = (v | v << 4) & 0x10c30c30c30c30c3ull;
  return (v | v << 2) & kMaskX;
}

/// Inverse of spread().
inline std::uint32_t compact(std::uint64_t v) {
  v &= kMaskX;
  v = (v | v >> 2) & 0x10c30c30c30c30c3ull;
  v = (v | v >> 4) & 0x100f00f00f00f00full;
  v = (v | v >> 8) & 0x001f0000ff0000ffull;
  v = (v | v >> 16) & 0x001f00000000ffffull;
  return static_cast<std::uint32_t>((v | v >> 32) & 0x1fffff);
}

inline std::uint64_t encode(GridPoint p) { return spread(p.x) | spread(p.y) << 1 | spread(p.z) << 2; }
inline GridPoint decode(std::uint64_t key) { return {compact(key), compact(key >> 1), compact(key >> 2)}; }

/// Child position (0..7) on the path from the node at `level` towards `key`.
inline int octant(std::uint64_t key, int level) { return static_cast<int>(key >> (3 * (kMaxLevel - 1 - level))) & 7; }

/// Edge of a cell in grid units.
inline std::uint32_t cell_extent(int level) { return 1u << (kMaxLevel - level); }

}  // namespace morton
}  // namespace st
