// (u,v) of a patch whose nodes are known in space alone.
#pragma once

#include "geometry/shape/surface.h"
#include "mesh/surface_mesh.h"
#include "meshing/face/face_boundary.h"

namespace st {

/// The node inside a patch that is furthest from the surface.
struct FurthestNode {
  double distance = 0;  ///< model unit
  Vec3 xyz;
};

/// Gives nodes and corners of a patch of `boundary`'s face the (u,v) of its surface: on the boundary those of its
/// loops, on seams of the side next to the triangle, inside by projection from neighbour to neighbour. Local, about
/// linear.
FurthestNode set_parameters(const Surface& surface, const FaceBoundary& boundary, const BoundaryNumbering& numbering,
                            FacePatch& patch);

}  // namespace st
