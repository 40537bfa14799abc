// Exports of a mesh, with a word on what they leave out.
#pragma once

#include <string>
#include <vector>

#include "io/export/export.h"

namespace st {

/// export_mesh(), and one warning of what the format has no room for. Local.
void export_and_warn(const std::string& path, const ExportMesh& mesh, const ExportOptions& options);

/// What ParaView is to show of each triangle: quality, and size_ratio, the mean length of its sides over the mean of
/// the sizes that its corners were asked for. Local, linear.
std::vector<TriangleValues> measured_values(const SurfaceMesh& mesh);

/// A file of one group.
struct GroupFile {
  std::string group, path;
  std::vector<TriangleId> triangles;
};
/// Those that export_groups() writes: of each group that has triangles.
std::vector<GroupFile> group_files(const std::string& path, const SurfaceMesh& mesh);
/// The name of the files of export_blocks(), before their groups: NAME/NAME.vtu.
std::string block_path(const std::string& path);

/// One file for each group that has triangles, named after it. Its elements are made anew.
std::vector<GroupFile> export_groups(const std::string& path, const ExportMesh& mesh, const ExportOptions& options);

/// ParaView's .vtm: a block for each group under its name, as a .vtu in a folder beside it, NAME/NAME_GROUP.vtu. Throws
/// Error(kOutput).
void export_blocks(const std::string& path, const ExportMesh& mesh, const ExportOptions& options);

}  // namespace st
