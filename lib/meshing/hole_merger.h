// The mesh again, once its holes are filled: what was kept is copied, what is new inserted.
#pragma once

#include <span>

#include "meshing/hole_filler.h"

namespace st {

/// What merge_patches() gives for the patches of all faces, without making patches of the faces that stay: canonical order, the orientation
/// of the old mesh, node_previous and triangle_previous filled. `redone` [n_faces]: by face, of make_hole_patch; without triangles: the
/// face is as it was. Local, linear.
SurfaceMesh insert_patches(const HoleNumbering& numbering, std::span<const FacePatch> redone);

}  // namespace st
