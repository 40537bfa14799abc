// Sizes from gaps and thin walls: surfaces that face each other.
#pragma once

#include <vector>

#include "sizing/octree.h"
#include "sizing/size_limits.h"

namespace st {

/// A sampled patch of a face as a flat disc.
struct FaceDisc {
  Vec3 x;                  ///< centre, model unit
  Vec3 normal;             ///< unit, out of the solid
  double radius = 0;       ///< encloses the patch, model unit
  double length = 0;       ///< that the patch asks for otherwise
  double min_length = 0;   ///< floor
  std::int32_t cause = 0;  ///< packed
};

/// Appends raster boxes with 1/gap_cells of the distance to the next disc that faces the disc (normals opposed by more than 135 degrees),
/// seen along the normal to either side, where that is less than the disc asks for; never below its min_length. They cover the square
/// around each disc. Surfaces that touch make no gap. Cost: a ray per box and side through a tree of discs.
void add_gap_boxes(const std::vector<FaceDisc>& discs, int gap_cells, double cell_per_length, std::vector<RasterBox>& boxes);

}  // namespace st
