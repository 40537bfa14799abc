// Parts of a mesh as meshes of their own.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesh/surface_mesh.h"

namespace st {

/// Triangles of each main group, ascending.
std::vector<std::vector<TriangleId>> triangles_by_group(const SurfaceMesh& mesh);

/// Adds the triangles of these faces (ascending) to those of each main group. `count`: [n_groups]
void count_groups(const SurfaceMesh& mesh, std::span<const FaceId> faces, std::span<std::int64_t> count);
/// The group that has most of those counted; empty: none, or one without a name of its own.
std::string main_group(const FaceLabels& labels, std::span<const std::int64_t> count);

/// Some triangles (ascending, each once) with the nodes that they use, both in their order, and the segments between
/// these. Labels keep all they have, so that numbers of faces and groups stay. Periodic pairs with a face that has no
/// triangle here are left out. n log n.
SurfaceMesh mesh_of_triangles(const SurfaceMesh& mesh, std::span<const TriangleId> triangles);

}  // namespace st
