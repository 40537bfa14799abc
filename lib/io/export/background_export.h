// A sizing artifact as the background mesh of another program.
#pragma once

#include <string>

#include "sizing/octree_field.h"

namespace st {

/// FLITE background mesh (.bac): the octree as a conforming tetrahedral mesh with three directions and spacings at each
/// node, no sources.
/// Throws Error(kOutput).
void export_bac(const OctreeField& field, const std::string& output);

/// Gmsh list-based view (.pos) of hexahedra with the length at their corners, or the metric where lengths are
/// stretched: `Merge "size.pos"; Field[1] = PostView;`. Throws Error(kOutput).
void export_pos(const OctreeField& field, const std::string& output);

}  // namespace st
