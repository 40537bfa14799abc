// How good are the rows of a stretched mesh: quadrilaterals cut into two triangles, and the triangles between them
// (docs/checks.md).
#pragma once

#include <cstdint>
#include <span>

#include "mesh/adjacency.h"
#include "mesh/surface_mesh.h"

namespace st {

/// Two triangles of one face are a quadrilateral where their common edge is the longest of both. It is of a row where
/// it is longer than kRowAspect times its height. Flatter ones continue a row where they have whole sides in common
/// with it, one after the other. All zero for a mesh without triangles.
struct RowStats {
  std::int64_t n_quads = 0, n_good = 0;  ///< good: all four angles in space within kLeastRowAngleDeg, kMostRowAngleDeg
  std::int64_t n_continued = 0;          ///< shorter ones that continue rows, nearly right-angled
  std::int64_t n_others = 0;             ///< triangles of no such quadrilateral
  double mean = 0, p1 = 0;               ///< of the others' quality: average, first percentile
  double growth = 1;                     ///< largest square root of the ratio of neighbours' areas in space
  std::int64_t n_grown = 0;              ///< pairs of neighbours above kMostRowGrowth
  double good_share() const { return n_quads ? static_cast<double>(n_good) / static_cast<double>(n_quads) : 1.0; }
};

inline constexpr double kRowAspect = 2;
inline constexpr double kLeastRowAngleDeg = 60, kMostRowAngleDeg = 120;
inline constexpr double kMostRowGrowth = 2.2;

/// Local, linear. `quality`: [n_triangles] as the sizes see them; half a square has 0.866 there.
RowStats measure_rows(const SurfaceMesh& mesh, const EdgeTable& edges, std::span<const double> quality);

}  // namespace st
