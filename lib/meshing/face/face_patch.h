// A face's patch: made from its mesh.
#pragma once

#include "geometry/model/model.h"
#include "mesh/surface_mesh.h"
#include "meshing/face/face_boundary.h"
#include "meshing/face/face_mesher.h"
#include "meshing/face/seam_mesh.h"

namespace st {

/// A face's mesh as a patch: boundary nodes once each, triangles out of the solid.
FacePatch make_patch(const ModelTables& t, FaceId face, const FaceBoundary& boundary, const FaceMesh& mesh,
                     const BoundaryNumbering& numbering);

/// Drops the nodes inside that no triangle uses. The patch is whole.
void drop_unused_nodes(FacePatch& patch);

/// Whether no place, (u,v) or length of it is infinite or none at all: what a patch must be to be stored. (u,v) are
/// none where the loops of a face are known in space alone.
bool has_numbers_only(const FacePatch& patch);

/// A section likewise.
FacePatch make_section(const ModelTables& t, FaceId face, Piece&& piece, const BoundaryNumbering& numbering);

}  // namespace st
