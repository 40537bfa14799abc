// New triangles that cross others, found without looking at the parts of the mesh that are far from them.
#pragma once

#include <span>
#include <vector>

#include "mesh/crossing.h"
#include "mesh/surface_mesh.h"

namespace st {

/// The pairs of find_crossing_patches of which one triangle at least is new (triangle_previous kNone), numbered as in
/// `mesh`, sorted; pairs with one common node are left out, as st-mesh does. `face_body` [n_faces]. Precondition:
/// triangles by face. Local; about linear in the triangles of faces near new ones.
std::vector<TrianglePair> find_new_crossings(const SurfaceMesh& mesh, std::span<const std::int32_t> face_body);

}  // namespace st
