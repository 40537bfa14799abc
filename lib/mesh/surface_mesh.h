// The surface mesh and the patches it is merged from: plain arrays.
#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "base/face_labels.h"
#include "base/ids.h"
#include "base/vec.h"
#include "mesh/edge_mesh.h"
#include "mesh/face_pair.h"

namespace st {

/// Three node ids, counter-clockwise seen from outside the solid.
struct Triangle {
  NodeId n[3];
};

/// A node inside a face, by the section of its patch that owns it and its number there.
struct InnerNode {
  std::int32_t section, number;
};

/// Triangulation of one CAD face. Nodes [0, n_boundary) lie on the face's edges and vertices and name their entity; the
/// rest are inside. A section of it has some of its triangles, with the nodes of these: those inside that other
/// sections own come last.
struct FacePatch {
  FaceId face = kNone;
  std::int32_t n_boundary = 0;
  std::vector<std::uint8_t> boundary_dim;     ///< [n_boundary] EntityDim: 0 vertex, 1 edge
  std::vector<std::int32_t> boundary_entity;  ///< [n_boundary] vertex id, or edge id
  std::vector<std::int32_t> boundary_index;   ///< [n_boundary] node index on that edge (1 .. n-2), 0 for a vertex
  std::vector<Vec3> inner_xyz;                ///< [n_inner]
  std::vector<Vec2> inner_uv;                 ///< [n_inner]
  std::vector<double> inner_size;             ///< [n_inner] requested length
  std::vector<Triangle> triangles;            ///< patch node ids; already oriented out of the solid
  std::vector<std::int32_t> uv_corner;  ///< ascending: corners 3*t + k whose (u,v) is not inner_uv of their node, as on
                                        ///< the boundary, where a node on a seam has two; see corner_uv()
  std::vector<Vec2> own_uv;             ///< likewise: their (u,v)
  std::vector<NodeId> inner_previous;   ///< empty, or [n_inner] number in the mesh that st-remesh started from, kNone:
                                        ///< new
  std::vector<TriangleId> triangle_previous;  ///< likewise [n_triangles]
  std::vector<InnerNode> owner;               ///< of the last inner nodes of a section; none of a whole patch
  std::vector<std::int32_t> boundary_number;  ///< of a section: [n_boundary] in the whole patch; empty: it has all

  std::int32_t n_own() const { return static_cast<std::int32_t>(inner_xyz.size() - owner.size()); }
  static auto fields(auto& p) {
    return std::tie(p.face, p.n_boundary, p.boundary_dim, p.boundary_entity, p.boundary_index, p.inner_xyz, p.inner_uv,
                    p.inner_size, p.triangles, p.uv_corner, p.own_uv, p.inner_previous, p.triangle_previous, p.owner,
                    p.boundary_number);
  }
};

/// CAD features far below the requested lengths, merged for meshing only (virtual topology). All ids 0-based, ascending
/// by edge and by face.
struct MergedFeatures {
  std::vector<EdgeId> edge;        ///< drawn together to one node each
  std::vector<FaceId> strip_face;  ///< [n_strips] a face between two long edges, closed where it is narrow
  std::vector<EdgeId> strip_kept, strip_closed;  ///< [n_strips] these: where closed, both have the nodes of `kept`
  std::vector<std::uint8_t> strip_is_opposed;    ///< [n_strips] 1: they run against each other
  std::vector<FacePair> pairs;                   ///< faces with one mesh; nothing on them is merged
  bool empty() const { return edge.empty() && strip_face.empty(); }
  bool operator==(const MergedFeatures&) const = default;

  static auto fields(auto& m) {
    return std::tie(m.edge, m.strip_face, m.strip_kept, m.strip_closed, m.strip_is_opposed, m.pairs);
  }
};

/// Faces of strips that are closed all along, so that they have no triangles: both long edges have nodes, all of them
/// common. Ascending.
std::vector<FaceId> closed_faces(const MergedFeatures& merged, const EdgeMesh& edges,
                                 const std::vector<VertexId>& edge_vertices);

/// Why a face could not be meshed.
struct FaceFailure {
  FaceId face = kNone;
  std::string cause;
  std::string remedy;
  Vec3 xyz;
  bool is_closed = false;  ///< it has triangles between the nodes of its loops instead: close_loops()
  bool is_near = false;    ///< and these are near its surface
  double deviation = 0;    ///< their largest distance from it, model unit
};

/// The merged mesh. Canonical: nodes by (entity dim, entity id, index), triangles by (face, position in its patch).
struct SurfaceMesh {
  std::vector<Vec3> node_xyz;
  std::vector<std::uint8_t> node_entity_dim;  ///< EntityDim
  std::vector<std::int32_t> node_entity;      ///< 0-based id of the vertex, edge or face
  std::vector<double> node_t;                 ///< edge parameter of nodes with dim 1, else 0
  std::vector<double> node_size;              ///< requested length
  std::vector<Triangle> triangles;
  std::vector<FaceId> triangle_face;         ///< 0-based CAD face
  std::vector<std::int32_t> triangle_group;  ///< main group, see FaceLabels
  std::vector<Vec2> corner_uv;               ///< [3*n_triangles]
  FaceLabels labels;
  std::vector<NodeId> segment_nodes;  ///< [2*n_segments] of the edges in groups only: by edge, along it from its t_min
  std::vector<EdgeId> segment_edge;   ///< [n_segments]
  MergedFeatures merged;
  std::vector<NodeId> node_previous;  ///< empty, or [n_nodes] number in the mesh that st-remesh started from, kNone:
                                      ///< new
  std::vector<TriangleId> triangle_previous;  ///< likewise [n_triangles]

  std::int64_t n_nodes() const { return static_cast<std::int64_t>(node_xyz.size()); }
  std::int64_t n_triangles() const { return static_cast<std::int64_t>(triangles.size()); }
};

}  // namespace st
