// Rows between two opposite sides of a loop with four corners, whose sides have as many nodes as those across. Internal
// to lib/meshing.
#pragma once

#include <vector>

#include "meshing/face/row_chains.h"
#include "meshing/face/row_line.h"

namespace st {

/// All lines from the bottom (not with it) to the top, by transfinite interpolation in the plane (Gordon and Hall
/// 1973). Columns are left out as a whole. Empty: the sides do not fit, or fewer than half of the columns would remain.
std::vector<NextLine> mapped_lines(FaceWork& work, const RowChain& chain);

}  // namespace st
