// Exports of a mesh, with a word on what they leave out.
#pragma once

#include <string>

#include "io/export/export.h"

namespace st {

/// export_mesh(), and one warning of what the format has no room for. Local.
void export_and_warn(const std::string& path, const ExportMesh& mesh, const ExportOptions& options);

/// Likewise one file for each group that has triangles, named after it. Returns how many.
std::size_t export_groups(const std::string& path, const SurfaceMesh& mesh, const ExportOptions& options);

}  // namespace st
