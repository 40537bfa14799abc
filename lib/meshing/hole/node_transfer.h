// Values of a mesh's nodes on the nodes of the mesh that it was remeshed to.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "meshing/hole/hole_mesh.h"

namespace st {

/// The value of a node from those of three of another mesh.
struct NodeStencil {
  NodeId n[3];
  double weight[3];  ///< none is negative; their sum is 1
};

/// Of the nodes of `now`, by those of `old`. Nodes that were in it (node_previous) keep their value. New ones on an
/// edge lie between the two old nodes on it by their parameter, new ones inside a face in the nearest old triangle of
/// that face: linear in both. So constants are kept to rounding, and smooth fields but for the square of the edges'
/// length. Local, by threads, the same at any number of them; n log n.
std::vector<NodeStencil> find_node_stencils(const HoleMesh& old, const SurfaceMesh& now);

/// `values`: [n_components] of each node. Returns likewise.
std::vector<double> transfer_values(std::span<const NodeStencil> stencils, std::span<const double> values,
                                    std::size_t n_components);

}  // namespace st
