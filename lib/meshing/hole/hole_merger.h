// The mesh again, once its holes are filled: what was kept is copied, what is new inserted.
#pragma once

#include <span>
#include <vector>

#include "meshing/hole/hole_filler.h"

namespace st {

/// In canonical order, with the orientation of the old mesh, node_previous and triangle_previous filled. `fills`
/// [n_faces]: of the holes of each face; none: the face is as it was. `left_out`: faces that get no triangles,
/// ascending. Local, linear.
SurfaceMesh insert_fills(const HoleNumbering& numbering, const HoleMarks& marks,
                         std::span<const std::vector<FaceMesh>> fills, std::span<const FaceId> left_out = {});

}  // namespace st
