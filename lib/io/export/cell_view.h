// Cells of any kind with numbers and names, to look at in ParaView.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/vec.h"

namespace st {

/// Cells as VTK has them.
struct CellView {
  std::vector<Vec3> points;
  std::vector<std::int32_t> nodes;                                        ///< of all cells
  std::vector<std::int64_t> offsets;                                      ///< [n_cells] end of each cell in `nodes`
  std::vector<std::uint8_t> types;                                        ///< [n_cells] 1 point, 3 line, 5 triangle
  std::vector<std::pair<std::string, std::vector<std::int32_t>>> values;  ///< name and [n_cells]
  std::vector<std::pair<std::string, std::vector<std::string>>> names;  ///< what they name, and names from number 1 on
};

/// Writes a .vtu. Throws Error(kOutput).
void write_cell_view(const std::string& path, const CellView& view);

}  // namespace st
