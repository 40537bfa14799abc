// Nodes on the CAD edges: made once, used by every face.
#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "base/ids.h"
#include "base/vec.h"

namespace st {

/// Nodes on all edges of a model, or on some curves: those of edge e are node_* [edge_offsets[e], edge_offsets[e+1]).
/// The first and the last lie on the edge's vertices (edge_vertices[2e], [2e+1]). A degenerate edge, and an edge not
/// meshed, has no nodes.
struct EdgeMesh {
  std::vector<std::int32_t> edge_offsets;  ///< [n_edges+1]
  std::vector<double> node_t;              ///< parameter on the edge, strictly increasing within an edge
  std::vector<Vec3> node_xyz;              ///< model unit; end nodes are the vertices' own coordinates
  std::vector<double> node_size;      ///< length it was made for at the node: the request, or less where that had to be
                                      ///< refined
  std::vector<double> node_request;   ///< requested length; empty: node_size
  std::vector<NodeId> node_previous;  ///< empty, or the node's number in the mesh that st-remesh started from, kNone:
                                      ///< new

  static auto fields(auto& m) {
    return std::tie(m.edge_offsets, m.node_t, m.node_xyz, m.node_size, m.node_request, m.node_previous);
  }

  EdgeId n_edges() const { return edge_offsets.empty() ? 0 : static_cast<EdgeId>(edge_offsets.size()) - 1; }
  std::int32_t first_node(EdgeId e) const { return edge_offsets[e]; }
  std::int32_t n_nodes(EdgeId e) const { return edge_offsets[e + 1] - edge_offsets[e]; }
  IdRange nodes(EdgeId e) const { return {edge_offsets[e], edge_offsets[e + 1]}; }
  const std::vector<double>& requests() const { return node_request.empty() ? node_size : node_request; }

  /// Without nodes.
  static EdgeMesh of_edges(EdgeId n_edges);
  /// Of one curve.
  static EdgeMesh of_curve(std::vector<double> t, std::vector<Vec3> xyz, std::vector<double> size);
  /// Adds edge `e` of another mesh as the next: parameters, points and sizes.
  void append(const EdgeMesh& other, EdgeId e = 0);
};

/// The same points, to the bit.
bool has_same_nodes(const EdgeMesh& a, const EdgeMesh& b, EdgeId e);

}  // namespace st
