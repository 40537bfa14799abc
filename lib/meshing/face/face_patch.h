// A face's patch: made from its mesh.
#pragma once

#include "geometry/model/model.h"
#include "mesh/surface_mesh.h"
#include "meshing/face/face_boundary.h"
#include "meshing/face/face_mesher.h"

namespace st {

/// A face's mesh as a patch: boundary nodes once each, triangles out of the solid.
FacePatch make_patch(const ModelTables& t, FaceId face, const FaceBoundary& boundary, const FaceMesh& mesh,
                     const BoundaryNumbering& numbering);

}  // namespace st
