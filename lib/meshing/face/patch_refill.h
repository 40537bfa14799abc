// Bad triangles of a finished patch, taken out and their place filled without new nodes.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mesh/surface_mesh.h"

namespace st {

/// One triangle of each pair that is folded onto each other, neighbours the cosine between whose normals is below
/// kFoldedCosine, and those without area. `xyz`: of the patch's nodes, those of its boundary first.
std::vector<std::size_t> find_flawed(std::span<const Vec3> xyz, const FacePatch& patch);

/// Takes out the bad triangles and some rings about them, as few as will do. The loop is filled with the triangles
/// between its nodes whose sharpest angle between neighbours is least, then of least area (Liepa 2003, Filling holes in
/// meshes). A place stays as it is where it is no disc, or where triangles would still be folded. Nodes inside it are
/// dropped, and no side of a bad triangle between two nodes of the patch's boundary is made again. Returns the number
/// of places filled. Local, pure.
int refill(std::span<const Vec3> xyz, std::span<const std::size_t> bad, FacePatch& patch);

}  // namespace st
