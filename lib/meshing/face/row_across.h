// What rows lead to: nodes of a loop or of other rows straight across. Internal to lib/meshing.
#pragma once

#include <cstdint>
#include <vector>

#include "meshing/face/row_line.h"

namespace st {

/// A line and where its next row would go, by columns.
struct RowAhead {
  const RowLine& line;
  const std::vector<char>& joined;         ///< [columns - 1]
  const std::vector<Vec3>&along, &across;  ///< unit vectors along the line and to its left
  const std::vector<double>& height;
};

/// Of the columns from `first` to `last`: the node straight across, a few heights away, where some beside each other
/// are ends of consecutive edges; a column that has arrived has its own; kNone: there is none.
void find_across(const FaceWork& work, const RowAhead& ahead, std::size_t first, std::size_t last,
                 std::vector<std::int32_t>& nodes);

}  // namespace st
