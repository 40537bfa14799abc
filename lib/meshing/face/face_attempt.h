// The record of a face that could not be meshed.
#pragma once

#include "mesh/face_attempt.h"
#include "meshing/face/face_boundary.h"
#include "meshing/face/face_mesher.h"

namespace st {

/// Local. `boundary` may be without nodes (no usable trimming curves): then the nodes on the face's CAD edges stand for
/// it, without (u,v).
FaceAttempt describe_attempt(const BoundaryNumbering& numbering, FaceId face, const FaceBoundary& boundary,
                             const FaceMesh& mesh);

}  // namespace st
