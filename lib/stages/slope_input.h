// Slopes of parts of the model. Internal to stages.
#pragma once

#include <string>
#include <vector>

#include "io/hdf5/sizing_artifact.h"

namespace st {

/// Slope of the faces of one name, else of a group or part (find_faces, face_labels.h).
struct NamedSlope {
  std::string name;
  double slope = 0;  ///< as ProlongStageOptions::slope
};

/// "WING=0.1, FLAP=0.15". Throws Error(kUsage).
std::vector<NamedSlope> parse_slopes(const std::string& text);

/// Per leaf of `octree` (the raster's, or refined from it): the slope of the faces in it, the smallest where several
/// have one; 0 elsewhere. Throws Error(kUsage) for a name that no face, group or part has.
std::vector<float> seed_slopes(const std::vector<NamedSlope>& slopes, const RasterArtifact& raster,
                               const OctreeView& raster_octree, const OctreeView& octree);

}  // namespace st
