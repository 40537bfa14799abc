// The octree of a raster or sizing artifact as cells that ParaView shows.
#pragma once

#include <string>

namespace st {

/// Writes the cells of a raster or sizing artifact as a VTK unstructured grid of voxels (.vtu): size (model unit; the
/// largest length where nothing is stored), level, cause_kind (0 edge, 1 face, 2 source, 3 other, -1 none), cause_id
/// (1-based, 0 none), colour where a surface blanks cells (0 flow, 1 cut, 2 blanked). A sizing also as the background
/// mesh of other programs: .pos (Gmsh), .bac (FLITE). Throws Error(kUsage) for another suffix, Error(kInput) for
/// another artifact, Error(kOutput).
void export_octree(const std::string& artifact, const std::string& output);

}  // namespace st
