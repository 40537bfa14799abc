// Where rows of quadrilaterals begin on a face: stretches of its loops whose segments are long for the lengths across.
// Internal to lib/meshing.
#pragma once

#include <cstdint>
#include <vector>

#include "meshing/face/front.h"

namespace st {

/// Nodes of a loop in a row, the face on their left.
struct RowChain {
  std::vector<std::int32_t> nodes;  ///< plane nodes, at least three
  /// The loop's further nodes where it turns off to the side of the rows at an end, that end first: before the first
  /// node, backwards, and after the last. Empty: the loop goes on otherwise.
  std::vector<std::int32_t> before, after;
  bool is_closed = false;  ///< a whole loop: the last node is the first
  /// Where the loop has four corners: the side with the chain, the one across, and those at its first and last node. Of
  /// a wedge with three the one at its apex is that node alone. Opposite sides run alike.
  std::vector<std::int32_t> bottom, top, left, right;
};

/// All of a face, in the order of its segments. The nodes have their sizes.
std::vector<RowChain> find_row_chains(const FaceWork& work);

/// Signed angle, radians, from the first step to the second about the normal; positive: to the left.
double turning(Vec3 first, Vec3 second, Vec3 normal);

}  // namespace st
