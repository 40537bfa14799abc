// Sharp edges with one patch of facets on both sides.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/facet/facet_mesh.h"

namespace st {

/// Sides of a rim at which a patch meets itself and turns by more than 120 degrees, as at the trailing edge of a wing
/// whose skin is one patch. Programs that read a mesh face by face take them for folds.
class KnifeSides {
 public:
  explicit KnifeSides(const FacetPatch& patch);

  bool any() const { return !sides_.empty(); }

  /// Whether a plane parts the patch so that half of the length of these sides, at least, lies between two pieces.
  /// `height`: as PatchDivider::divide() takes it. O(triangles).
  bool are_parted_by(const std::vector<double>& height) const;

 private:
  struct Side {
    std::int32_t triangle, other;  ///< of the patch
    std::int32_t a, b;             ///< own nodes of the first one
  };

  const FacetPatch& patch_;
  std::vector<Side> sides_;
};

}  // namespace st
