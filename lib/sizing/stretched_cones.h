// Which samples of the raster tell the length along a direction in which edges may be longer.
#pragma once

#include "sizing/cones.h"
#include "sizing/sample_sites.h"

namespace st {

/// Stretches the cones of `table` (of spread_cones(), of the same `samples` and `slope`, which told the `sites`) as
/// their samples allow, and finds which tell the lengths along. At a place the direction is that of the cone that tells
/// the length there. The length along it is the smallest, over all samples, of what a sample asks for in this direction
/// where its lengths across and along have grown by slope * distance. A sample reaches the sites to which
/// links lead from those where it tells a length, over sites where it tells the length along, or nearly. Nothing where
/// no sample is stretched. Local, the same on every run.
void add_stretch(const OctreeView& octree, std::span<const LengthSample> samples, std::span<const float> slope,
                 const SampleSites& sites, ConeTable& table);

}  // namespace st
