// A sizing artifact as the background mesh of another program.
#pragma once

#include <string>

#include "sizing/octree_field.h"

namespace st {

/// FLITE background mesh (.bac): the octree as a conforming tetrahedral mesh with isotropic spacings, no sources.
/// Throws Error(kOutput).
void export_bac(const OctreeField& field, const std::string& output);

/// Gmsh list-based view (.pos) of hexahedra with the length at their corners: `Merge "size.pos"; Field[1] = PostView;`.
/// Throws Error(kOutput).
void export_pos(const OctreeField& field, const std::string& output);

}  // namespace st
