// Which samples of the raster tell the length along a direction in which edges may be longer.
#pragma once

#include "sizing/cones.h"

namespace st {

/// Stretches the cones of `table` (of spread_cones(), of the same arguments) as their samples allow, and finds which
/// tell the lengths along. At a place the direction is that of the cone that tells the length there. The length along
/// it is the smallest, over all samples, of what a sample asks for in this direction plus slope * distance, so it grows
/// by the slope as long as the direction stays. A sample reaches the sites to which links lead from those where it
/// tells a length, over sites where it tells the length along, or nearly. Nothing where no sample is stretched. Local,
/// the same on every run.
void add_stretch(const Neighbours& neighbours, std::span<const LengthSample> samples, std::span<const float> slope,
                 const Blanking* blanking, ConeTable& table);

}  // namespace st
