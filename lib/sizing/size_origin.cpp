#include "sizing/size_origin.h"

#include <cmath>

namespace st {

SizeOrigin find_origin(const OctreeFieldData& field, const Neighbours& neighbours, std::int32_t leaf) {
  constexpr double kRounding = 1e-5;  // sums of floats along the chain
  const OctreeView& octree = field.octree;
  SizeOrigin origin{leaf, 0, {}, 0};
  while (field.cause[leaf] != kNone) {
    const double length = static_cast<double>(field.cells[leaf].length);
    std::int32_t next = kNone;
    double least = length * (1 + kRounding);
    neighbours.for_each(leaf, [&](std::int32_t other, const CellStep& step) {
      const double from = static_cast<double>(field.cells[other].length);
      if (field.cause[other] != field.cause[leaf] || !(from < length)) return;
      const double half = 0.5 * octree.cell_edge(step.fine_level);
      const double through = from + field.slope * half * std::sqrt(static_cast<double>(step.length2));
      if (through < least || (through == least && other < next)) {
        least = through;
        next = other;
      }
    });
    if (next == kNone) break;
    leaf = next;
    ++origin.n_cells;
  }
  origin.leaf = leaf;
  origin.length = field.scale * static_cast<double>(field.cells[leaf].length);
  origin.xyz = octree.leaf_center(leaf);
  return origin;
}

}  // namespace st
