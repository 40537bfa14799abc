// Obtuse triangles mended in space, where the surface's normals and (u,v) tell nothing: at folded places.
#pragma once

#include <span>
#include <vector>

#include "mesh/surface_mesh.h"
#include "meshing/face/face_node.h"
#include "meshing/face/flaw_mending.h"

namespace st {

/// Of triangles with an angle in space above this one, radians, an edge is swapped, or else an inner node goes onto one
/// beside it, where that makes the largest angle of all that change smaller. No change joins seam twins or nodes that
/// are joined already, or makes an edge sharper than 60 degrees and than those about it were. Nodes that go onto others
/// make no larger step of size than kMostGrowth and than was there. `triangles`: of one face; those of two nodes that
/// became one go. Returns the number of changes. Local, pure; linear but for blunt triangles.
int mend_blunt(std::span<const FaceNode> nodes, std::vector<Triangle>& triangles, double above = kMostAngle);

/// Likewise in a whole patch, whose nodes without triangles go. `xyz`: of its nodes, those of its boundary first.
int mend_blunt(std::span<const Vec3> xyz, FacePatch& patch, double above = kMostAngle);

}  // namespace st
