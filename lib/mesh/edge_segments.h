// Which sides of triangles lie on the CAD edges that are in groups.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesh/surface_mesh.h"

namespace st {

/// Fills segment_nodes and segment_edge of a mesh in canonical order for the edges of its groups; without such groups
/// they stay empty. `edges`: the edge mesh that the mesh was made of; `edge_vertices` [2*n_edges]: vertices of merged
/// edges made one. Where a strip is closed its closed edge has the segments of the kept one. Edges that were merged to
/// a node, or of faces without triangles, have none. Local.
void add_segments(SurfaceMesh& mesh, const EdgeMesh& edges, std::span<const VertexId> edge_vertices);

/// The same for all edges, from the mesh alone: node after node of each edge where a side of a triangle joins them. A
/// closed strip's closed edge has none. Linear time but for a logarithm.
void add_all_segments(SurfaceMesh& mesh, std::span<const VertexId> edge_vertices);

/// A table's groups of edges or of vertices as numbers of nodes.
struct NodeGroups {
  std::string name;                     ///< of the array: "edge_group", "edge_group_bc", "vertex_group" ...
  std::vector<std::string> group_name;  ///< of number 1, 2 ...
  std::vector<std::int32_t> of_node;    ///< [n_nodes] from 1, 0: in none; at the end of edges of two groups the smaller
                                        ///< number
};

/// One for each table that has groups of edges, then likewise of vertices; the main table first, others in the order of
/// their first group.
std::vector<NodeGroups> node_groups(const SurfaceMesh& mesh);

}  // namespace st
