// The sources and background mesh that st-prolong is given. Internal to stages.
#pragma once

#include <string>
#include <vector>

#include "io/hdf5/artifact.h"
#include "io/toml/source_file.h"
#include "sizing/face_cells.h"
#include "sizing/octree.h"
#include "sizing/source_set.h"

namespace st {

/// What st-prolong is given besides the raster.
struct SourceInput {
  SourceSet set;                   ///< in the octree's frame
  std::vector<std::string> names;  ///< [set.sources]
  std::vector<InputRef> files;     ///< for the header
};

/// Reads files in order. Sources are told apart by name; a later one replaces an earlier one; nameless ones add up.
/// `motion` brings everything into the octree's frame. A line without length, or a triangle without area, is taken as a
/// point or a line, and a background that grows faster than `slope` is lowered, with a warning. Of a background with
/// metrics only what is near `faces` stays, cells of `raster`. Throws Error(kInput), Error(kUsage).
SourceInput read_sources(const std::vector<std::string>& files, const std::string& background, const Similarity& motion,
                         double slope, const ModelScale& scale, const FaceCells& faces, const OctreeView& raster);

/// Warns of each source whose core lies outside the root cube of the octree, and of a background mesh that does: there
/// is nothing to mesh. `far_length`: longer lengths are of no interest; `unit` of all lengths, as messages have it.
void warn_of_places(const SourceInput& input, const OctreeView& octree, double far_length, const std::string& unit);
/// Says how much of the faces' area lies outside the box of a background mesh, and how far.
void warn_of_outside(const BackgroundMesh& background, const FaceCells& faces, const std::string& unit);

}  // namespace st
