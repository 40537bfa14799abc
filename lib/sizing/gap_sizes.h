// Sizes from gaps and thin walls: surfaces that face each other.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "sizing/crossing_parts.h"
#include "sizing/octree.h"
#include "sizing/patch_tree.h"

namespace st {

/// Finds the gaps of patches, one patch after the other in any order.
class GapFinder {
 public:
  /// The place next to a point on the edges in which the faces of two causes meet; nullopt: they do not. Any thread.
  using MeetingPlace = std::function<std::optional<Vec3>(std::int32_t cause, std::int32_t other, Vec3 x)>;

  /// `patches` must outlive the object. Cost: O(n log n).
  GapFinder(std::span<const GapPatch> patches, double cell_per_length, MeetingPlace meeting_place);

  /// Appends raster boxes with 1/gap_cells of the distance along the patch's normal, 1/wall_cells against it, to the
  /// next patch that faces it (normals opposed by more than 135 degrees), where that is less than the patch asks for;
  /// never below its min_length. Patches are paraboloids, so that distances between curved walls are those of the
  /// surfaces. The boxes cover the part of the patch that sees a gap. Surfaces that touch make no gap, nor do two
  /// that close up towards an edge in which they meet, or where two solids cross; walls end with their solid. Nothing
  /// to a side whose cells are not given.
  void add_boxes(std::size_t patch, std::vector<RasterBox>& boxes) const;

 private:
  std::span<const GapPatch> patches_;
  double cell_per_length_;
  MeetingPlace meeting_place_;
  PatchTree tree_;
  CrossingParts parts_;
};

}  // namespace st
