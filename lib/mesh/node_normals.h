// Normals of a mesh at its nodes.
#pragma once

#include <span>
#include <vector>

#include "base/vec.h"
#include "mesh/surface_mesh.h"

namespace st {

/// [nodes] unit vectors: the mean of the normals of the triangles there, by their areas; zero where there is none.
std::vector<Vec3> node_normals(std::span<const Vec3> node_xyz, std::span<const Triangle> triangles);

}  // namespace st
