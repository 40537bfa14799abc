// Rows of quadrilaterals, cut into triangles, laid along the stretches of a face's loops before the front starts.
// Internal to lib/meshing.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "meshing/face/front.h"
#include "meshing/face/row_line.h"

namespace st {

/// Lays the rows of a face whose sizes are stretched: its triangles are kLaid, its nodes is_laid, its edges must stay.
/// What cannot be laid is left to the front. Returns the edges of the last lines, the face on their left.
std::vector<std::pair<std::int32_t, std::int32_t>> lay_row_blocks(FaceWork& work);

/// A closed line that is no longer joined all around becomes an open one, which begins and ends at a gap.
void open_at_gap(RowLine& line);

}  // namespace st
