// A patch with far fewer nodes, and the way back: nodes are taken out one by one, each with its ring.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/shape/chart_topology.h"

namespace st {

/// A node that was taken out: the triangles around it became a fan from one of its ring.
struct RemovedNode {
  std::int32_t node = kNone;                ///< of the fine patch
  std::int32_t first_ring = 0, n_ring = 0;  ///< in CoarsePatch::ring
  bool is_rim = false;       ///< its ring is open then, and begins and ends with its neighbours on the rim
  bool is_from_end = false;  ///< the fan starts from the last of the ring, else from the first one
};

struct CoarsePatch {
  std::vector<Vec3> x;               ///< [coarse nodes]
  std::vector<Corners> corners;      ///< coarse nodes
  std::vector<std::int32_t> node;    ///< [coarse nodes] of the fine patch, ascending
  std::vector<RemovedNode> removed;  ///< the one that went first is the first
  std::vector<std::int32_t> ring;    ///< nodes of the fine patch around removed ones, counter-clockwise

  std::span<const std::int32_t> ring_of(const RemovedNode& r) const {
    return {ring.data() + r.first_ring, static_cast<std::size_t>(r.n_ring)};
  }
};

/// Takes nodes out until about `most_triangles` are left, or no node can go: new triangles turn little from the old
/// ones and are no needles, loops keep their corners, and the patch stays what it is (link condition). Nodes whose
/// stars do not touch go together (Lee et al. 1998, MAPS). Linear; the same input gives the same patch.
/// Precondition: `topology` is that of the patch, and it is manifold.
CoarsePatch coarsen(std::span<const Vec3> x, std::span<const Corners> corners, const PatchTopology& topology,
                    std::size_t most_triangles);

}  // namespace st
