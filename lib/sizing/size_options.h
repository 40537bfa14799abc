// Numbers that sizes are made from, for the whole model (options of st-raster) and for parts of it (keys of [[size]]).
#pragma once

#include "base/number_option.h"

namespace st {

struct SizeOptions {
  static constexpr NumberOption kAlpha{
      "--alpha", "DEG", "[0.001, 90]",
      "curvature angle: largest angle in degrees by which normal or tangent turn along one edge length"};
  // of these three a rule may also give 0: off
  static constexpr NumberOption kGapCells{
      "--gap-cells", "N", "[1, 100]",
      "proximity: number of edge lengths across gaps in the flow, down to --lmin; default: off"};
  static constexpr NumberOption kWallCells{
      "--wall-cells", "N", "[1, 100]",
      "number of edge lengths across thin walls, inside the material, down to --lmin; default: off"};
  static constexpr NumberOption kEdgeCells{
      "--edge-cells", "N", "[1, 100]",
      "smallest number of edge lengths along each CAD edge, down to --lmin; default: 1"};
  static constexpr NumberOption kMaxAspect{
      "--max-aspect", "A", "[1, 100]",
      "largest edge length along noses, edges and flat directions, divided by the length across; 1: none is longer"};
};

}  // namespace st
