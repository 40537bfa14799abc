// Second derivatives of a field that is known at the nodes of a mesh.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sizing/background.h"

namespace st {

struct NodeHessians {
  std::vector<SymmetricTensor> of_node;  ///< [n_nodes] of the field over the squared model unit
  std::int64_t n_unknown = 0;            ///< nodes with too few others around them: zero
};

/// By a quadric through each node's value, fitted to those of the rings around it: at least twice as many nodes as
/// unknowns, weighted by one over the squared distance, in coordinates that their scatter scales. Exact for quadratic
/// fields on volumes. On a surface (no tetrahedra) the quadric is one over the tangent plane, and across it the largest
/// derivative in it stands; the rings do not pass sharp edges, and nodes on these take the mean of their neighbours.
/// Zero where a field is linear but for the rounding of its values.
/// `value`: [n_nodes]. The same bits for every number of threads. O(n).
NodeHessians fit_hessians(const BackgroundMesh& mesh, std::span<const double> value);

}  // namespace st
