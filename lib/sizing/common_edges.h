// Edges in which two faces meet.
#pragma once

#include <optional>
#include <vector>

#include "geometry/model/model.h"

namespace st {

/// Immutable.
class CommonEdges {
 public:
  /// `model` outlives it. Cost: O(n log n) in the edges.
  explicit CommonEdges(const Model& model);

  /// The place next to `x` on the edges that bound both faces; nullopt: these have none. Local. Cost: makes the curves
  /// of these edges.
  std::optional<Vec3> nearest(FaceId a, FaceId b, Vec3 x) const;

 private:
  struct Use {
    FaceId a, b;  // a < b
    EdgeId edge;
    auto operator<=>(const Use&) const = default;
  };

  const Model& model_;
  std::vector<Use> uses_;  // ascending
};

}  // namespace st
