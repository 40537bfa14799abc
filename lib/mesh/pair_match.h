// The nodes of a periodic pair, side by side.
#pragma once

#include <utility>
#include <vector>

#include "mesh/surface_mesh.h"

namespace st {

/// Of the model's diagonal: how far a node may lie from the image of its partner.
inline constexpr double kPairMatch = 1e-12;

struct PairMatch {
  std::vector<std::pair<NodeId, NodeId>> nodes;  ///< of face a, of face b: by the former
  std::vector<NodeId> alone;                     ///< nodes of either face without a partner, ascending
  std::vector<TriangleId> triangles_alone;       ///< likewise, where all their nodes have one
};

/// `tolerance`: model unit. n log n in the nodes of the two faces, linear in the mesh.
PairMatch match_pair(const SurfaceMesh& mesh, const FacePair& pair, double tolerance);

/// kPairMatch of a box's diagonal, model unit; more where its coordinates are so large that they are rounded by more.
double pair_tolerance(const Box3& box);
/// By the box of the nodes.
double pair_tolerance(const SurfaceMesh& mesh);

}  // namespace st
