// Where the facets of a model without CAD cross each other.
#pragma once

#include <vector>

#include "base/box_tree.h"
#include "geometry/model/facet_shape.h"

namespace st {

/// Found once, when it is made: about n log n.
class FacetCrossings {
 public:
  explicit FacetCrossings(const FacetShape& shape);
  /// Two facets have more in common than the nodes they share, at a place no farther from x than `reach` along each
  /// axis.
  bool is_near(Vec3 x, double reach) const;

 private:
  std::vector<Box3> places_;
  BoxTree tree_;
};

}  // namespace st
