// Sizes from gaps and thin walls: surfaces that face each other.
#pragma once

#include <span>
#include <vector>

#include "sizing/octree.h"
#include "sizing/patch_tree.h"

namespace st {

/// Finds the gaps of patches, one patch after the other in any order.
class GapFinder {
 public:
  /// `patches` must outlive the object. Cost: O(n log n).
  GapFinder(std::span<const GapPatch> patches, double cell_per_length);

  /// Appends raster boxes with 1/gap_cells of the distance along the patch's normal, 1/wall_cells against it, to the
  /// next patch that faces it (normals opposed by more than 135 degrees), where that is less than the patch asks for;
  /// never below its min_length. Patches are paraboloids, so that distances between curved walls are those of the
  /// surfaces. The boxes cover the part of the patch that sees a gap. Surfaces that touch make no gap, and walls end
  /// with their solid. Nothing to a side whose cells are not given.
  void add_boxes(std::size_t patch, std::vector<RasterBox>& boxes) const;

 private:
  std::span<const GapPatch> patches_;
  double cell_per_length_;
  PatchTree tree_;
};

}  // namespace st
