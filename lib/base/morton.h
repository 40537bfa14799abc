// Morton (Z-order) keys of octree cells: 20 bits per axis, interleaved, x lowest.
#pragma once

#include <array>
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

/// Edge of a cell in grid units.
inline std::uint32_t cell_extent(int level) { return 1u << (kMaxLevel - level); }

}  // namespace morton

inline constexpr int kCornerBits = 21;  ///< corners of cells lie at 0 .. 2^20

/// A corner as one number: a step along axis k adds 1 << (k * kCornerBits).
inline std::uint64_t pack_corner(GridPoint p) {
  return p.x | static_cast<std::uint64_t>(p.y) << kCornerBits | static_cast<std::uint64_t>(p.z) << (2 * kCornerBits);
}

/// Inverse of pack_corner().
inline GridPoint unpack_corner(std::uint64_t corner) {
  constexpr std::uint64_t mask = (1u << kCornerBits) - 1;
  return {static_cast<std::uint32_t>(corner & mask), static_cast<std::uint32_t>(corner >> kCornerBits & mask),
          static_cast<std::uint32_t>(corner >> (2 * kCornerBits))};
}

/// Corners of the cell with this key and level, x fastest (VTK's voxel).
inline std::array<std::uint64_t, 8> packed_corners(std::uint64_t key, int level) {
  const GridPoint p = morton::decode(key);
  const std::uint32_t e = morton::cell_extent(level);
  std::array<std::uint64_t, 8> corners;
  for (std::uint32_t c = 0; c < 8; ++c)
    corners[c] = pack_corner({p.x + (c & 1) * e, p.y + (c >> 1 & 1) * e, p.z + (c >> 2) * e});
  return corners;
}

}  // namespace st
