// Narrow faces whose long sides are in several pieces, as vertices on a blunt trailing edge cut them.
#pragma once

#include <vector>

#include "features/strip.h"
#include "geometry/model/model.h"

namespace st {

/// A strip for each edge on the long sides of faces with one loop that has corners (45 degrees) at the ends of two long
/// sides, about equally long, of which one has several edges: its first edge is that one, the second one lies across
/// from its middle, and `cut_side` is set. `row` is the length of the side. Ascending by face. Local.
std::vector<Strip> find_cut_bases(const Model& model);

}  // namespace st
