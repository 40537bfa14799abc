// Meshes for other programs.
#pragma once

#include <cstddef>
#include <string>

#include "mesh/surface_mesh.h"

namespace st {

/// Throws Error(kUsage) unless the suffix is one that export_mesh knows.
void require_export_suffix(const std::string& path);

/// Exports by suffix: .stl (binary, one solid), .ascii.stl (one solid per group), .vtu, .obj, .ply, .msh (Gmsh 4.1),
/// .fro, .ugrid, .lb8.ugrid and .b8.ugrid (with .mapbc beside), .su2, .bdf, .nas, .mesh, .off, .smesh, .poly. Names of
/// faces, groups and parts go into all that can hold them (docs/st-export.md). Returns how many groups of edges and
/// vertices the format cannot hold. Throws Error(kUsage) for an unknown suffix, Error(kOutput).
std::size_t export_mesh(const std::string& path, const SurfaceMesh& mesh);

}  // namespace st
