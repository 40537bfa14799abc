// Cells of any usual kind as tetrahedra and triangles.
#include <algorithm>
#include <span>
#include <utility>

#include "io/foreign/cell_file.h"

namespace st {
namespace {

// VTK's numbers of cells; those of curved ones have the same corners first.
constexpr std::int64_t kVertex = 1, kPolyVertex = 2, kLine = 3, kPolyLine = 4, kTriangle = 5, kPixel = 8, kQuad = 9,
                       kTet = 10, kVoxel = 11, kHexahedron = 12, kWedge = 13, kPyramid = 14, kCurvedEdge = 21,
                       kCurvedTriangle = 22, kCurvedQuad = 23, kCurvedTet = 24, kCurvedHexahedron = 25,
                       kCurvedWedge = 26, kCurvedPyramid = 27;

/// Corners of a side, in order around it; -1: it has three.
using Side = std::array<int, 4>;
constexpr Side kTetSides[] = {{0, 1, 2, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {2, 0, 3, -1}};
constexpr Side kPyramidSides[] = {{0, 1, 2, 3}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}};
constexpr Side kWedgeSides[] = {{0, 1, 2, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
constexpr Side kHexahedronSides[] = {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                     {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

std::span<const Side> sides_of(int n_corners) {
  switch (n_corners) {
    case 4:
      return kTetSides;
    case 5:
      return kPyramidSides;
    case 6:
      return kWedgeSides;
    default:
      return kHexahedronSides;
  }
}

/// Corners in order around their sides: VTK's boxes along the axes have theirs by rows.
std::array<std::int32_t, 8> in_order(std::int64_t type, const std::int32_t* corner) {
  std::array<std::int32_t, 8> c{};
  std::copy_n(corner, n_corners_of(type), c.begin());
  if (type == kVoxel || type == kPixel) std::swap(c[2], c[3]);
  if (type == kVoxel) std::swap(c[6], c[7]);
  return c;
}

/// The triangles of a side, cut from its lowest node.
template <class Visit>
void for_each_triangle(const std::int32_t* corner, const Side& side, const Visit& visit) {
  const int n = side[3] < 0 ? 3 : 4;
  int first = 0;
  for (int k = 1; k < n; ++k)
    if (corner[side[k]] < corner[side[first]]) first = k;
  for (int k = 1; k + 1 < n; ++k)
    visit(std::array<std::int32_t, 3>{corner[side[first]], corner[side[(first + k) % n]],
                                      corner[side[(first + k + 1) % n]]});
}

}  // namespace

int n_corners_of(std::int64_t type) {
  switch (type) {
    case kVertex:
    case kPolyVertex:
    case kLine:
    case kPolyLine:
    case kCurvedEdge:
      return 0;
    case kTriangle:
    case kCurvedTriangle:
      return 3;
    case kPixel:
    case kQuad:
    case kCurvedQuad:
    case kTet:
    case kCurvedTet:
      return 4;
    case kPyramid:
    case kCurvedPyramid:
      return 5;
    case kWedge:
    case kCurvedWedge:
      return 6;
    case kVoxel:
    case kHexahedron:
    case kCurvedHexahedron:
      return 8;
    default:
      return -1;
  }
}

bool is_volume(std::int64_t type) {
  const int n = n_corners_of(type);
  return n > 4 || type == kTet || type == kCurvedTet;
}

void split_volume(std::int64_t type, const std::int32_t* corner, std::vector<std::array<std::int32_t, 4>>& tets) {
  const std::array<std::int32_t, 8> c = in_order(type, corner);
  const int n = n_corners_of(type);
  const std::int32_t lowest = *std::min_element(c.begin(), c.begin() + n);
  if (n == 4) {
    tets.push_back({c[0], c[1], c[2], c[3]});
    return;
  }
  for (const Side& side : sides_of(n)) {
    const bool has_lowest = std::ranges::any_of(side, [&](int k) { return k >= 0 && c[k] == lowest; });
    if (has_lowest) continue;
    for_each_triangle(c.data(), side, [&](const std::array<std::int32_t, 3>& t) {
      tets.push_back({lowest, t[0], t[1], t[2]});
    });
  }
}

void split_surface(std::int64_t type, const std::int32_t* corner, std::vector<std::array<std::int32_t, 3>>& triangles) {
  const std::array<std::int32_t, 8> c = in_order(type, corner);
  const Side side = n_corners_of(type) == 3 ? Side{0, 1, 2, -1} : Side{0, 1, 2, 3};
  for_each_triangle(c.data(), side, [&](const std::array<std::int32_t, 3>& t) { triangles.push_back(t); });
}

}  // namespace st
