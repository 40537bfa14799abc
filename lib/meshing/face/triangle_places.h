// Surroundings of some triangles of a face, to be made again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/surface_mesh.h"

namespace st {

/// Triangles that hang together, and the loop around them.
struct TrianglePlace {
  std::vector<std::size_t> triangles;  ///< ascending
  int n_seeds = 0;                     ///< of these
  std::vector<NodeId> loop;            ///< the place on the left; empty: not one loop
};

/// Some rings of triangles about the seeds, those that share a node in one place. Linear in the triangles.
std::vector<TrianglePlace> places_about(std::span<const Triangle> triangles, std::int64_t n_nodes,
                                        std::span<const std::size_t> seeds, int rings);

}  // namespace st
