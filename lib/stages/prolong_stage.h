// st-prolong: the complete mesh size specification from a raster, sources and a background mesh.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/number_option.h"
#include "stages/summary.h"

namespace st {

struct ProlongStageOptions {
  std::string raster;  ///< raster artifact, or a sizing whose sources and scale are changed
  std::string output = "sizing.hdf";
  double slope = 0.2;
  static constexpr NumberOption kSlope{"--slope", "S", "[1e-6, 2]",
                                       "largest change of edge length per distance; 0.2 is a growth rate of 1.2"};
  std::string slope_of;  ///< "WING=0.1, FLAP=0.15": slope where lengths come from faces of these names; empty: none
  double scale = 1.0;
  static constexpr NumberOption kScale{"--scale", "F", "(0, 1e6]", "factor that multiplies every length"};
  std::vector<std::string> sources;  ///< files of sources (TOML, .bac, .ba3); later ones replace sources of the same
                                     ///< name
  std::string background;            ///< background mesh, see read_background_file() and read_size_mesh(); empty: none
  bool only = false;                 ///< lengths come from the background alone, between the raster's lmin and lmax
  std::string transform;  ///< moves sources and background into the model's frame; see parse_similarity; empty: as they
                          ///< are
  std::string geometry;   ///< what st-edit --transform made of the raster's geometry: the octree moves with it; empty:
                          ///< that one
  std::string family;     ///< a ratio, or "dpw"; empty: none
  static constexpr NumberOption kFamily{
      "--family", "RATIO", "(1, 4]",
      "grid family: also write OUTPUT-coarse and OUTPUT-fine, lengths multiplied and divided by this ratio; dpw: "
      "OUTPUT-L1 to -L6 of the drag prediction workshops, L3 as OUTPUT"};
  std::optional<int> target_triangles;
  static constexpr NumberOption kTargetTriangles{
      "--target-triangles", "N", "[4, 2e9]",
      "scale all lengths so that the mesh has about this many triangles; default: no scaling"};
  std::optional<int> max_triangles;
  static constexpr NumberOption kMaxTriangles{
      "--max-triangles", "N", "[4, 2e9]",
      "end with exit code 2 when the sizes need more triangles; default: a warning above 5 million"};
  std::string blank;      ///< closed mesh (mesh.hdf, STL): cells on its other side carry no lengths to the flow; empty:
                          ///< the raster's own surface
  bool no_blank = false;  ///< lengths pass through solids
  std::string blank_side = "auto";  ///< "inside", "outside", or "auto": outside when a group of the mesh is the far
                                    ///< field
  std::string sample;               ///< CSV of points at which lengths are written to `sample_output`; empty: none
  std::string sample_output = "sizes.csv";
  bool allow_incomplete = false;  ///< take a raster of which parts could not be sampled

  /// Throws Error(kUsage) for what no octree could be filled with.
  void validate() const;
};

/// Local. Throws Error.
StageSummary run_prolong(const ProlongStageOptions& options);

}  // namespace st
