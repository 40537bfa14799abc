// Values at the nodes of a mesh, carried to the mesh that st-remesh makes of it.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/hdf5/node_values.h"
#include "meshing/hole/hole_mesh.h"

namespace st {

/// Of FILE:ARRAY. Throws Error(kUsage), with the option that has it.
std::pair<std::string, std::string> file_and_array(const std::string& option, const std::string& text);

/// `of_file`: [nodes of the file][n_components]; `file_node`: number in the file of each node of the mesh.
std::vector<double> in_mesh_order(std::span<const double> of_file, std::span<const NodeId> file_node,
                                  std::size_t n_components);

/// Arrays of FILE:ARRAY,ARRAY... at the nodes of a mesh, see read_node_values(). `n_nodes`: of the file that the mesh
/// is read from; `file_node` as above, empty: nodes are in its order. None for an empty text. Throws Error(kUsage),
/// also for names of arrays that meshes have, and Error(kInput).
std::vector<NodeValues> read_carried_values(const std::string& text, std::size_t n_nodes,
                                            std::span<const NodeId> file_node);

/// Gives them to the nodes of `now`, of which node_previous counts the nodes of `old`.
void carry_values(const HoleMesh& old, const SurfaceMesh& now, std::vector<NodeValues>& arrays);

}  // namespace st
