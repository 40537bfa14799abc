// The patches of a mesh again, once its holes are filled.
#pragma once

#include <span>
#include <vector>

#include "meshing/hole/hole_filler.h"

namespace st {

/// The patch of each face ([n_faces]): triangles that are kept, then those of its fills, with the orientation of the
/// old mesh; inner_previous and triangle_previous are filled. `fills` [n_faces]: of the holes of each face; none: the
/// face is as it was. `left_out`: faces that get no triangles, ascending. Throws Error(kInput) where a triangle of the
/// old mesh has a node inside another face. Local, linear.
std::vector<FacePatch> insert_fills(const HoleNumbering& numbering, const HoleMarks& marks,
                                    std::span<const std::vector<Piece>> fills, std::span<const FaceId> left_out = {});

/// The mesh of these patches, with groups and labels of the old one. Linear.
SurfaceMesh weld_filled(const HoleNumbering& numbering, std::span<const FacePatch> patches);

}  // namespace st
