// The octree of raster boxes that are spread over the ranks.
#pragma once

#include <span>
#include <vector>

#include "comm/communicator.h"
#include "sizing/octree.h"
#include "sizing/sample_seeds.h"

namespace st {

/// Collective, the same on every rank: the box around which the octree is built. It is the model's. Where cells of the
/// deepest level would be too large for some sample in it, it is that of the walls, a diagonal larger on each side,
/// unless that is no help, or what lies outside (a far field) asks for lengths below half of `far_length`: those
/// samples are lost, and lengths grow there by the slope up to `far_length`.
Box3 choose_octree_box(const Box3& model, const Box3& walls, std::span<const RasterBox> own_boxes, double far_length,
                       const Communicator& comm);

/// Collective. What build_octree makes of the boxes of all ranks: the shape on every rank, the stored lengths complete
/// on rank 0 only. Each rank looks for the cells that its own boxes split and meet; rank 0 unites them. The result does
/// not depend on which rank has which box. `root`, `max_cells`: the same on every rank. Throws TooManyCells, before
/// most of the memory is used, on some rank at least.
RasterOctree build_common_octree(const Box3& root, std::span<const RasterBox> own_boxes, std::uint64_t max_cells,
                                 const Communicator& comm);

/// Collective. The samples of each rank with their places, see sorted_samples(); of all ranks on rank 0, of its own
/// alone elsewhere.
std::vector<std::vector<LengthSample>> gather_samples(std::span<const RasterBox> own_boxes, Vec3 origin,
                                                      const Communicator& comm);

}  // namespace st
