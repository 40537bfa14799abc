// Solids that cross each other, told by the patches of their faces.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "base/box_tree.h"
#include "sizing/gap_patch.h"

namespace st {

/// Beside the line in which two solids cross, their walls face each other like those of a gap.
class CrossingParts {
 public:
  /// `patches` must outlive the object. Looks at those of solids whose lengths may be stretched. O(n log n), constant
  /// where these are of one solid.
  explicit CrossingParts(std::span<const GapPatch> patches);

  /// Whether a gap of width `d` (model unit) at `x` on `own` closes along both walls until one solid is in the other.
  /// Not where a wall ends before that. Any thread.
  bool cross_where_closed(const GapPatch& own, const GapPatch& other, Vec3 x, double d) const;

 private:
  /// A place above a patch, behind it where the height is negative.
  struct Above {
    const GapPatch* patch;
    double height;  // model unit
  };

  std::optional<Above> nearest_below(std::int32_t solid, Vec3 x, double reach) const;

  std::span<const GapPatch> patches_;
  BoxTree tree_;
};

}  // namespace st
