// Meshes for other programs.
#pragma once

#include <cstddef>
#include <string>

#include "mesh/quad_pairs.h"
#include "mesh/surface_mesh.h"
#include "sizing/size_field.h"

namespace st {

/// Throws Error(kUsage) unless the suffix is one that export_mesh knows, and of a format with quadrilaterals where
/// these are wanted.
void require_export_suffix(const std::string& path, bool wants_quads = false);

/// Exports by suffix: .stl (binary, one solid), .ascii.stl (one solid per group), .vtu, .obj, .ply, .msh (Gmsh 4.1),
/// .fro, .ugrid, .lb8.ugrid and .b8.ugrid (with .mapbc beside), .su2, .bdf, .nas, .mesh, .off, .smesh, .poly. Names of
/// faces, groups and parts go into all that can hold them (docs/st-export.md). Returns how many groups of edges and
/// vertices the format cannot hold. Throws Error(kUsage) for an unknown suffix, Error(kOutput).
std::size_t export_mesh(const std::string& path, const SurfaceMesh& mesh);

/// Likewise with pairs of triangles as quadrilaterals: .vtu, .msh, .ugrid (all three), .su2, .mesh. Elements are in the
/// order triangles, quadrilaterals (.msh: by face).
std::size_t export_mesh(const std::string& path, const SurfaceMesh& mesh, const QuadPairs& elements);

/// The requested size at each node as Medit's .sol: a length, or the metric where `field` is stretched. Throws
/// Error(kOutput).
void export_sol(const std::string& path, const SurfaceMesh& mesh, const SizeField& field);

}  // namespace st
