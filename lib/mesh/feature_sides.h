// Sides of a mesh along which its shape or meaning changes.
#pragma once

#include <array>
#include <vector>

#include "mesh/surface_mesh.h"

namespace st {

/// Sides of one triangle or of three and more, sides between groups, and sides where the normals turn by at least
/// `angle_deg`, (0, 180]. Lower node first, ascending. Linear time but for the log of the valence.
std::vector<std::array<NodeId, 2>> feature_sides(const SurfaceMesh& mesh, double angle_deg);

}  // namespace st
