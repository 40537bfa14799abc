// Where the length of a cell comes from: the chain of cells through which the prolongation brought it.
#pragma once

#include "sizing/neighbours.h"
#include "sizing/octree_field.h"

namespace st {

/// The far end of the chain.
struct SizeOrigin {
  std::int32_t leaf = 0;     ///< the cell whose own length it is
  double length = 0;         ///< there, at its centre, scaled
  Vec3 xyz;                  ///< its centre
  std::int32_t n_cells = 0;  ///< passed on the way
};

/// Follows the cause of the length of `leaf` back to the cell that stored it.
SizeOrigin find_origin(const OctreeFieldData& field, const Neighbours& neighbours, std::int32_t leaf);

}  // namespace st
