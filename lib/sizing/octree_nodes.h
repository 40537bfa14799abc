// How octrees are made from the cells that must be split: the steps of build_octree, for boxes that are spread over
// ranks, too.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/limits.h"
#include "sizing/octree.h"

namespace st {

/// Inner cells of each level as keys relative to their level (3*level bits).
using NodeLevels = std::array<std::vector<std::uint64_t>, kMaxLevel>;

/// Sorts each level and adds what tree and balance need.
void close_nodes(NodeLevels& nodes);

/// Numbers the nodes level by level and the leaves in Morton order, and links them. `shape` has its root cube already.
void link_tree(const NodeLevels& nodes, OctreeShape& shape);

/// Inner cells that these boxes ask for, closed. Those of all boxes are the union of those of any parts: see
/// unite_nodes. Throws TooManyCells as soon as they make more than `max_cells` leaves; their own memory is a fraction
/// of that.
NodeLevels split_cells(const Box3& root, std::span<const RasterBox> boxes, std::uint64_t max_cells = kMaxIds);

/// Leaves of the octree with these inner cells.
std::uint64_t count_leaves(const NodeLevels& nodes);

/// Union, level by level; all sorted and unique, as close_nodes leaves them.
void unite_nodes(NodeLevels& nodes, const NodeLevels& other);

/// The octree with these inner cells (closed).
OctreeShape make_shape(const Box3& root, const NodeLevels& nodes);

/// Stored length and cause of each leaf as one number that orders by length, then by cause; ~0: nothing stored.
/// [n_leaves]. What all boxes store is, leaf by leaf, the smallest number that any parts of them store.
using PackedLengths = std::vector<std::uint64_t>;

/// What these boxes store. Precondition: the shape has the cells that they split.
PackedLengths store_boxes(const OctreeShape& shape, std::span<const RasterBox> boxes);

RasterOctree unpack_octree(OctreeShape shape, const PackedLengths& packed);

}  // namespace st
