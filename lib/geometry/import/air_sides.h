// Outer faces of a flow domain that were one before something cut them.
#pragma once

#include <span>
#include <vector>

#include "geometry/import/air_pieces.h"

namespace st::occt {

/// Faces that hang together and go on as one surface.
struct AirSide {
  std::vector<FaceId> faces;  ///< ascending
  double area = 0;            ///< of all, square of the model unit
  double width = 0;           ///< model unit; of the rectangle of the same area and perimeter
};

/// Those among `faces`, in the order of their first faces: at an edge between two of one side, direction and curvature
/// go on. So pieces of a sphere are one side, a fillet and the plane beside it are two. Cost: linear in coedges, for
/// faces of few edges.
std::vector<AirSide> sides_of(const AirPieces& pieces, std::span<const FaceId> faces);

}  // namespace st::occt
