// Nodes that are one but for a gap.
#pragma once

#include <cstddef>

#include "geometry/facet/facet_mesh.h"

namespace st {

/// Of the diagonal: single precision, and the rounding of decimals in text.
inline constexpr double kFacetGap = 1e-6;

struct JoinedGaps {
  std::size_t n_nodes = 0;      ///< joined to others
  double gap = 0;               ///< the widest that was asked for, at least kFacetGap (model unit)
  Vec3 place;                   ///< of the first one
  bool had_free_sides = false;  ///< before
};

/// Joins nodes at free sides (that one facet has) within 1e-6 of the diagonal; while sides are free then, within 1e-5
/// and 1e-4, if that leaves fewer of them, as far as no side gets shorter by more than half.
JoinedGaps join_gaps(FacetInput& input, double diagonal);

}  // namespace st
