// How much the surface turns at the CAD's edges.
#pragma once

#include <utility>
#include <vector>

#include "geometry/model/face_coedge.h"
#include "geometry/model/model.h"

namespace st {

/// Normals of both sides within it all along an edge: nothing but the CAD's division of a surface.
inline constexpr double kSmoothEdgeDeg = 3;

/// Looks up the CAD's edges as they are asked for.
class EdgeAngles {
 public:
  /// `model` outlives it. Of an edge that turns by more than `most_deg` one such angle is enough.
  explicit EdgeAngles(const Model& model, double most_deg = 180);
  /// Largest angle between the normals on both sides at nine places along it, degrees in [0, 180]; 180 where not
  /// exactly two coedges use the edge, it is degenerate, or a normal is missing at a place. Cost: up to 18 evaluations,
  /// at the first call for each edge. For any thread.
  double largest_deg(EdgeId e);

 private:
  double measure(EdgeId e) const;

  const Model& model_;
  double most_deg_;
  std::vector<std::vector<FaceCoedge>> uses_;  // [n_edges]
  std::vector<double> largest_;                // [n_edges] below 0: not asked yet
};

}  // namespace st
