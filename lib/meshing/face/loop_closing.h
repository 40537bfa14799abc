// The last resort for a face that cannot be meshed in (u,v): triangles between the nodes of its loops.
#pragma once

#include "meshing/face/face_mesher.h"

namespace st {

struct ClosedFace {
  FaceMesh mesh;         ///< FailureCause::kNone where the loops could be closed
  double deviation = 0;  ///< largest distance between the middle of a triangle and the surface, model unit
  bool is_near = true;   ///< no triangle is further from the surface than `allowed` and a tenth of its longest side,
                         ///< and none that is wider than `allowed` is turned over
};

/// Closes the loops of a face whatever they look like in (u,v), crossing or touching themselves. Holes are joined to
/// the outer loop by their shortest ways, and of all triangulations of the polygon's nodes the one of the least area on
/// the surface is taken (Barequet and Sharir 1995, Liepa 2003); long sides are split at points of the surface, and
/// sides swapped. Every segment of the loops is used once; those that go to and fro are not used. `surface`: null where
/// it cannot be evaluated or the nodes have no (u,v). Local, pure.
ClosedFace close_loops(const Surface* surface, const FaceBoundary& boundary, const SizeField& field, double allowed);

}  // namespace st
