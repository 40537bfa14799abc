// How much the surface turns at the CAD's edges.
#pragma once

#include <utility>
#include <vector>

#include "geometry/model/model.h"

namespace st {

/// Normals of both sides within it all along an edge: nothing but the CAD's division of a surface.
inline constexpr double kSmoothEdgeDeg = 3;

/// Looks up the CAD's edges as they are asked for.
class EdgeAngles {
 public:
  /// `model` outlives it.
  explicit EdgeAngles(const Model& model);
  /// Largest angle between the normals on both sides at nine places along it, degrees in [0, 180]; 180 where not
  /// exactly two coedges use the edge, or a normal is missing at a place.
  double largest_deg(EdgeId e);

 private:
  struct Use {
    FaceId face;
    CoedgeId coedge;
  };
  double measure(EdgeId e) const;

  const Model& model_;
  std::vector<std::vector<Use>> uses_;  // [n_edges]
  std::vector<double> largest_;         // [n_edges] below 0: not asked yet
};

}  // namespace st
