// One row more: where the nodes of the next line lie, from those of a line. Changes nothing. Internal to lib/meshing.
#pragma once

#include <cstdint>
#include <vector>

#include "meshing/face/front.h"

namespace st {

/// The nodes of a line over the columns of a block, the rows to come on their left.
struct RowLine {
  std::vector<std::int32_t> nodes;    ///< plane nodes; kNone: the column has ended
  std::vector<double> lowest;         ///< [nodes] least height of a column so far, 0 at the beginning
  std::vector<double> highest;        ///< [nodes] greatest height of a column since then, that is after its least
  std::vector<char> joined;           ///< [nodes - 1] does the next row go on between columns i and i+1?
  bool is_closed = false;             ///< the last column is the first, and all are joined
  std::vector<char> arrived = {};     ///< [nodes] does the column end at a node across? Empty: none
  std::vector<LocalSize> asked = {};  ///< [nodes] what the field told there, length 0: not known; or empty

  bool has_arrived(std::size_t i) const { return !arrived.empty() && arrived[i]; }
  bool is_known(std::size_t i) const { return !asked.empty() && asked[i].length > 0; }
};

/// What bounds the next row at an end: the next node of a loop there, kNone: nothing.
struct RowSides {
  std::int32_t first = kNone, last = kNone;
};

/// The next line: a node, or an existing one, for each column that may go on.
struct NextLine {
  struct Column {
    MeshNode node;
    std::int32_t existing = kNone;
    bool is_placed = false;
    bool is_across = false;  ///< the existing node is one of what lies across: the column ends there
    LocalSize asked = {};    ///< what the field told at the node; length 0: not known
  };
  std::vector<Column> columns;
  std::vector<char> joined;  ///< which quadrilaterals are good
};

/// Its heights are those of the sizes, smoothed along the line; its columns are square to the line, and turn towards
/// the sides near these. A quadrilateral is left out where it would be about as high as long, folded or askew, a column
/// where less than most of a row is free beyond. Where a node of a loop or of other rows lies straight across, a few
/// rows away, whole rows lead to it.
NextLine next_line(FaceWork& work, const RowLine& line, const RowSides& sides);

/// The point at a distance from `a` along the unit vector `d` of its tangent plane; false where the surface turns away.
bool step_on_surface(const FaceWork& work, const MeshNode& a, Vec3 d, double length, MeshNode& p);

}  // namespace st
