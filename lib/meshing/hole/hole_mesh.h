// A merged mesh seen from the CAD again: which nodes and segments lie on which edge, which triangles on which face.
#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "geometry/model/model.h"
#include "mesh/surface_mesh.h"
#include "meshing/face/face_boundary.h"

namespace st {

/// One segment of a CAD edge: between node `index` of the edge mesh (over all edges) and the next.
struct CadSegment {
  NodeId low = kNone, high = kNone;  ///< mesh nodes, low < high
  EdgeId edge = kNone;
  std::int32_t index = kNone;  ///< into EdgeMesh::node_*; also the segment's number
};

/// The mesh with its relation to the model's entities. The mesh outlives it.
struct HoleMesh {
  /// Linear. Throws Error(kInput) when the mesh is not finite, not in canonical order or names entities that the model
  /// does not have. `tables`: the model's, as the CAD has it; `model` is needed when the mesh has merged strips.
  HoleMesh(const SurfaceMesh& mesh, const ModelTables& tables, const Model* model = nullptr);

  HoleMesh(const HoleMesh&) = delete;

  const SurfaceMesh& mesh;
  const MeshTopology topology;             ///< with what the mesh merged
  const ModelTables& tables;               ///< of `topology`
  EdgeMesh edges;                          ///< as st-mesh made it; edges of which a vertex has no node have none
  std::vector<NodeId> edge_node;           ///< [edges.node_t] mesh node of each
  std::vector<CadSegment> segments;        ///< sorted by (low, high, index)
  std::vector<NodeId> vertex_node;         ///< [n_vertices] kNone: none
  std::vector<std::int32_t> node_on_edge;  ///< [n_nodes] into edges.node_*, for nodes inside an edge; else kNone
  std::vector<TriangleId> face_begin;      ///< [n_faces+1]
  std::vector<NodeId> inner_begin;         ///< [n_faces+1] nodes inside face f: [inner_begin[f], inner_begin[f+1])
  std::vector<char> face_is_turned;        ///< [n_faces] 1: its triangles run clockwise in (u,v)

  TriangleId face_size(FaceId f) const { return face_begin[f + 1] - face_begin[f]; }
  /// All segments between two mesh nodes; several where edges of one segment share both vertices.
  std::span<const CadSegment> segments_between(NodeId a, NodeId b) const;

 private:
  using StripNodes = std::map<EdgeId, std::vector<std::pair<NodeId, double>>>;  // inner nodes of closed edges, and
                                                                                // their t
  StripNodes closed_strip_nodes(const std::vector<NodeId>& first_on_edge, const Model* model) const;
  void add_edge(EdgeId e, const std::vector<NodeId>& first_on_edge, const StripNodes& strips);
};

}  // namespace st
