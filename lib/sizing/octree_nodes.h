// How octrees are made from the cells that must be split. Internal to sizing.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sizing/octree.h"

namespace st {

/// Inner cells of each level as keys relative to their level (3*level bits).
using NodeLevels = std::array<std::vector<std::uint64_t>, kMaxLevel>;

/// Sorts each level and adds what tree and balance need.
void close_nodes(NodeLevels& nodes);

/// Numbers the nodes level by level and the leaves in Morton order, and links them. `shape` has its root cube already.
void link_tree(const NodeLevels& nodes, OctreeShape& shape);

}  // namespace st
