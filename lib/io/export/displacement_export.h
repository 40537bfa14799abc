// How far the nodes of a mesh moved, for programs that deform volume meshes.
#pragma once

#include <span>
#include <string>

#include "mesh/surface_mesh.h"

namespace st {

/// Throws Error(kUsage) unless the suffix is .vtu or .csv.
void require_displacement_format(const std::string& path);

/// Writes where each node was (`from`: [n_nodes], model unit) and the vector to where it is in `moved`. .vtu: the
/// triangles at their former places and the point data `displacement`; .csv: a line "node,x,y,z,dx,dy,dz" and a line
/// for each node, numbers from 0, 17 digits. Throws Error(kUsage) for other suffixes, Error(kOutput).
void export_displacements(const std::string& path, std::span<const Vec3> from, const SurfaceMesh& moved);

}  // namespace st
