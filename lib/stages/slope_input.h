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

/// Where the slopes of named faces start.
class SlopeSeeds {
 public:
  /// Throws Error(kUsage) for a name that no face, group or part has.
  SlopeSeeds(const std::vector<NamedSlope>& slopes, const RasterArtifact& raster);

  /// Of the named face that is the cause, or whose cells take their lengths from the edge that is; 0: none.
  double of_cause(std::int32_t cause) const;

 private:
  std::vector<double> of_face_, of_edge_;  // 0: not named
};

}  // namespace st
