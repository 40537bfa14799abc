// The patches of a mesh again, once its holes are filled.
#pragma once

#include <span>
#include <vector>

#include "meshing/hole/hole_filler.h"

namespace st {

/// The patches of faces with fills, by face ([n_faces]; without a face, kNone, where there are none and the face is as
/// it was): triangles that are kept, then those of the fills, with the orientation of the old mesh. inner_previous and
/// triangle_previous are filled. `fills` [n_faces]: of the holes of each face. Throws Error(kInput) where a triangle of
/// the old mesh has a node inside another face. Local, linear.
std::vector<FacePatch> insert_fills(const HoleNumbering& numbering, const HoleMarks& marks,
                                    std::span<const std::vector<Piece>> fills);

/// Adds those of faces that are as they were. `left_out`: faces that get no triangles, ascending.
void add_old_patches(const HoleNumbering& numbering, std::span<const FaceId> left_out, std::vector<FacePatch>& patches);

/// The mesh of these patches and of all faces that are as they were, with groups and labels of the old one. Linear.
SurfaceMesh weld_filled(const HoleNumbering& numbering, std::span<const FacePatch> patches);

}  // namespace st
