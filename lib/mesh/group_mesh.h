// Parts of a mesh as meshes of their own.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "mesh/surface_mesh.h"

namespace st {

/// Triangles of each main group, ascending.
std::vector<std::vector<TriangleId>> triangles_by_group(const SurfaceMesh& mesh);

/// The group that most triangles of these faces (ascending) are in; empty: none, or one without a name of its own.
std::string main_group(const SurfaceMesh& mesh, std::span<const FaceId> faces);

/// Some triangles (ascending, each once) with the nodes that they use, both in their order, and the segments between
/// these. Labels keep all they have, so that numbers of faces and groups stay. Periodic pairs with a face that has no
/// triangle here are left out. n log n.
SurfaceMesh mesh_of_triangles(const SurfaceMesh& mesh, std::span<const TriangleId> triangles);

}  // namespace st
