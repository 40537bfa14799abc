// How the triangles of a patch hang together: neighbours, rim loops, genus.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "base/vec.h"

namespace st {

/// The nodes of a triangle, counter-clockwise.
using Corners = std::array<std::int32_t, 3>;

/// [n_triangles] the triangle across side k, from corner k to the next one; kNone where the side is used once, more
/// than twice, or twice the same way.
std::vector<Corners> find_neighbours(std::span<const Corners> corners);

/// What a patch is. A disc has one component, genus 0 and one loop.
struct PatchTopology {
  std::int32_t n_components = 0;                 ///< connected across sides
  std::int32_t genus = 0;                        ///< of all components together
  bool is_manifold = true;                       ///< the triangles around each node are one fan
  std::vector<std::vector<std::int32_t>> loops;  ///< nodes along the rim, the patch on the left; lowest node first
  std::vector<double> loop_length;               ///< [n_loops] model unit

  /// Of the longest loop, the first one of several. Precondition: there is a loop.
  std::size_t outer_loop() const;
};

/// Linear but for sorting. `x`: places of the nodes, all of which are used.
PatchTopology find_topology(std::span<const Vec3> x, std::span<const Corners> corners);

}  // namespace st
