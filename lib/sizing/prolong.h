// Slope-limited prolongation: from stored sample lengths to one length for each cell.
#pragma once

#include "sizing/neighbours.h"
#include "sizing/octree.h"

namespace st {

struct ProlongOptions {
  double slope = 0.2;     ///< largest change of length per distance, > 0
  double max_length = 0;  ///< length where nothing asks for less, model unit, > 0
};

/// The largest lengths, [n_leaves], with h <= stored, h <= max_length and h(a) <= h(b) + slope * |centre a - centre b|
/// for all cells a, b that touch at a face: ways across faces are up to sqrt(3) times as long as straight ones. Minimum
/// over paths of sums rounded in path order: a unique fixed point, so the result is exactly reproducible. O(n) in
/// practice. Precondition: balanced octree.
std::vector<float> prolong(const Neighbours& neighbours, std::span<const float> stored_length,
                           const ProlongOptions& options);

}  // namespace st
