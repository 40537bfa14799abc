// A balanced octree as a conforming tetrahedral mesh: what other programs take as a background mesh.
#pragma once

#include <array>
#include <vector>

#include "sizing/octree.h"

namespace st {

/// Nodes: the corners of all leaves, then the centres of all leaves. Tetrahedra of a leaf: its centre with triangles
/// that fill its sides.
struct OctreeTets {
  std::vector<Vec3> node_xyz;
  std::int64_t n_corners = 0;
  std::vector<std::array<std::int32_t, 4>> tets;  ///< positive volume
};

/// Conforming: the side between two leaves is triangulated alike from both, by the corners of finer leaves that lie on
/// it. 12 to 48 tetrahedra per leaf. O(n log n). Precondition: balanced.
OctreeTets octree_tets(const OctreeView& octree);

}  // namespace st
