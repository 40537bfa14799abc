// Chains of mesh edges along CAD edges: the first half of an association.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/lists_by_key.h"
#include "geometry/model/model.h"
#include "mesh/adjacency.h"
#include "mesh/surface_mesh.h"

namespace st {

/// Mesh edges of a triangulation with the sides on them, and those at each node.
struct MeshEdges {
  MeshEdges(const std::vector<Triangle>& triangles, std::int64_t n_nodes);
  std::vector<NodeId> low, high;           ///< [n_edges], sorted
  std::vector<std::int32_t> side_offsets;  ///< [n_edges+1]
  std::vector<SideId> sides;
  ListsByKey<> at_node;                    ///< mesh edges, ascending
  std::vector<std::int32_t> edge_of_side;  ///< [3*n_triangles] kNone for triangles with a repeated node
  std::int32_t n_edges() const { return static_cast<std::int32_t>(low.size()); }
  NodeId other(std::int32_t edge, NodeId n) const { return low[edge] == n ? high[edge] : low[edge]; }
  std::span<const std::int32_t> at(NodeId n) const { return at_node[static_cast<std::size_t>(n)]; }
  std::span<const SideId> sides_of(std::int32_t edge) const {
    return std::span(sides).subspan(side_offsets[edge], side_offsets[edge + 1] - side_offsets[edge]);
  }
};

/// How far a node may be from the CAD, model unit.
struct NodeTolerance {
  std::vector<double> of_node;  ///< [n_nodes]
  bool adds_cad = true;         ///< the CAD entity's own tolerance comes on top
  double at(NodeId n, double cad_tolerance) const { return of_node[n] + (adds_cad ? cad_tolerance : 0); }
};

/// A CAD edge as the mesh follows it: from the node at t_min to the one at t_max.
struct EdgeChain {
  std::vector<NodeId> node;
  std::vector<double> t;           ///< [nodes] parameters, strictly increasing
  std::vector<std::int32_t> edge;  ///< [nodes-1] mesh edges
};

/// The mesh's nodes on CAD vertices and edges.
struct EdgeChains {
  MergedFeatures merged;            ///< short edges without a mesh edge
  ModelTables tables;               ///< the model's with those merged
  std::vector<NodeId> vertex_node;  ///< [n_vertices] kNone: a vertex of no edge, or represented by another
  std::vector<EdgeChain> chain;     ///< [n_edges] empty for degenerate and merged edges
  std::vector<EdgeId> node_edge;    ///< [n_nodes] edge inside which the node lies, else kNone
  std::vector<VertexId> node_vertex;
  double max_distance = 0;
  Vec3 max_place;
};

/// For each mesh edge the CAD edge whose chain it belongs to, and its place there.
struct ChainSegments {
  /// Throws Error(kMismatch) when two chains have a mesh edge in common.
  ChainSegments(const MeshEdges& edges, const EdgeChains& chains);
  std::vector<EdgeId> edge;         ///< [n_edges] kNone: inside a face
  std::vector<std::int32_t> index;  ///< [n_edges] between nodes index and index + 1 of the chain
};

/// Throws Error(kMismatch) naming the vertices without a node, and the edges that no chain follows. Local.
EdgeChains find_edge_chains(const SurfaceMesh& mesh, const MeshEdges& edges, const Model& model,
                            const NodeTolerance& tolerance);

}  // namespace st
