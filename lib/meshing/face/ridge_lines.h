// Lines of nodes along noses and round tails inside a face, from which rows are laid. Internal to lib/meshing.
#pragma once

#include <cstdint>
#include <vector>

#include "meshing/face/front.h"

namespace st {

/// Lays nodes along the lines of a face on which lengths across are least and edges may be longer along them: from the
/// loops, where lengths have a least one along these too. Nodes are one length along apart, and the edges between them
/// must stay. Returns the nodes of each line, in order; at least four, none of a loop. Linear in their number.
std::vector<std::vector<std::int32_t>> lay_ridges(FaceWork& work);

}  // namespace st
