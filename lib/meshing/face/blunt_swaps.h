// Edges swapped in space, where the surface's normals and (u,v) tell nothing: at folded places.
#pragma once

#include <span>
#include <vector>

#include "mesh/surface_mesh.h"
#include "meshing/face/face_node.h"

namespace st {

/// Swaps edges of triangles with an angle in space above kMostAngle where that makes the largest angle of both smaller.
/// No swap joins seam twins or nodes that are joined already, or makes an edge sharper than 60 degrees and than those
/// about it were. `triangles`: of one face. Returns the number of swaps. Local, pure; linear but for blunt triangles.
int swap_blunt(std::span<const FaceNode> nodes, std::vector<Triangle>& triangles);

/// Likewise in a patch. `xyz`: of its nodes, those of its boundary first.
int swap_blunt(std::span<const Vec3> xyz, FacePatch& patch);

}  // namespace st
