// Two facets on each other that hang on the others by some of their sides alone.
#pragma once

#include "geometry/facet/facet_mesh.h"

namespace st {

using TwinFacets = std::pair<std::int32_t, std::int32_t>;

/// Of pairs of facets with the same three nodes those that are flaps: turned against each other, one or two sides that
/// no other facet has, and two others at each further side. Without both the rest is closed as it was. Two polygons
/// with two common sides are divided into such. Sheets of several pairs are none: they may be meant.
std::vector<TwinFacets> find_flaps(const std::vector<Corners>& corners, const std::vector<TwinFacets>& pairs);

}  // namespace st
