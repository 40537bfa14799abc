// One mesh from the patches of all faces: welded by ids, oriented out of the solid, in canonical order.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "mesh/surface_mesh.h"

namespace st {

/// Number of a node on a vertex (itself) or on an edge: all vertices, then all edges.node_*. The ends of edges are
/// vertices and have no number there.
inline std::int32_t boundary_id(VertexId n_vertices, const EdgeMesh& edges, EdgeId e, std::int32_t index) {
  return n_vertices + edges.first_node(e) + index;
}

/// The same number of a boundary node of a patch.
std::int32_t boundary_id_of(VertexId n_vertices, const EdgeMesh& edges, const FacePatch& p, std::int32_t boundary_node);

/// [n_boundary + n_inner] 1: a triangle of the patch has this node.
std::vector<std::uint8_t> used_nodes(const FacePatch& p);

/// What a patch brings to the mesh of all.
struct PatchUse {
  std::vector<std::int32_t> boundary;  ///< boundary ids that its triangles have
  std::int64_t n_inner = 0;            ///< nodes inside that they have
  std::int64_t n_triangles = 0;
};

PatchUse use_of(const EdgeMesh& edges, VertexId n_vertices, const FacePatch& p);

/// What nodes and triangles of patches are called in the mesh of all: add() each, then number(). Nodes by (entity dim,
/// entity id, index), only those that a triangle has; triangles by (patch, position in it).
///
/// A patch may be in sections; and what other patches may have of it may be known by other ids than boundary_id().
struct PatchNumbers {
  /// `n_ids`: of nodes that several patches may have.
  explicit PatchNumbers(std::size_t n_ids) : boundary(n_ids, kNone) {}
  PatchNumbers(const EdgeMesh& edges, std::size_t n_vertices) : PatchNumbers(n_vertices + edges.node_xyz.size()) {}
  /// Of the sections of one patch, which keeps its `n_boundary` nodes: [n_sections] nodes of their own inside.
  static PatchNumbers of_sections(std::int32_t n_boundary, std::span<const std::int32_t> n_own);

  /// The next patch. Throws Error when the mesh has more than ids can count.
  void add(const PatchUse& use);
  void number();
  NodeId n_boundary() const { return inner_begin.front(); }
  NodeId n_nodes() const { return inner_begin.back(); }
  TriangleId n_triangles() const { return triangle_begin.back(); }
  /// Of each node of patch i; kNone: no triangle has it.
  std::vector<NodeId> of_patch(const EdgeMesh& edges, const FacePatch& shape, std::size_t i) const;
  /// Of each node of piece i: those with these ids, its own ones, and those that other pieces own.
  std::vector<NodeId> of_piece(std::size_t i, std::span<const std::int32_t> ids, std::int32_t n_own,
                               std::span<const InnerNode> owner = {}) const;
  /// Puts the nodes on vertices and edges into their places.
  void place_boundary(const EdgeMesh& edges, std::span<const Vec3> vertex_xyz, std::vector<Vec3>& node_xyz) const;
  /// Room for all patches.
  SurfaceMesh make_mesh() const;
  /// Likewise, with the places of nodes on vertices and edges.
  SurfaceMesh make_mesh(const EdgeMesh& edges, std::span<const Vec3> vertex_xyz) const;
  /// Puts what is inside patch i, with its triangles, into their places.
  void place_patch(const EdgeMesh& edges, const FacePatch& shape, std::size_t i, SurfaceMesh& mesh) const;
  /// Its triangles alone. `number`: of each of its nodes.
  void place_triangles(const FacePatch& shape, std::size_t i, std::span<const NodeId> number, SurfaceMesh& mesh) const;

  std::vector<NodeId> boundary;                  ///< node by id; kNone: no triangle has it
  std::vector<NodeId> inner_begin = {0};         ///< [n_patches+1] the first node inside each
  std::vector<TriangleId> triangle_begin = {0};  ///< [n_patches+1]
};

/// Patches joined by the ids of their nodes.
struct WeldedPatches {
  SurfaceMesh mesh;  ///< places, triangles and the faces of these alone
  PatchNumbers numbers;
};

/// Joins patches in the given order; those without triangles may stand among them. Throws Error(kInput) when a patch
/// names an entity or node that does not exist. Linear.
WeldedPatches weld_patches(const EdgeMesh& edges, std::span<const Vec3> vertex_xyz,
                           std::span<const FacePatch* const> patches);

/// Views of what a patches artifact holds. The order of `patches` is irrelevant; a face occurs once at most.
struct MergeInput {
  const EdgeMesh& edges;
  std::span<const Vec3> vertex_xyz;          ///< [n_vertices]
  std::span<const VertexId> edge_vertices;   ///< [2*n_edges]
  std::span<const FacePatch> patches;        ///< of the faces that were meshed
  std::span<const std::int32_t> face_group;  ///< [n_faces] main group; may be empty: group 0
};

/// What the orientation had to change. Ids 0-based, ascending.
struct OrientationReport {
  std::vector<FaceId> turned_faces;      ///< turned to agree with their neighbours (the model's faces disagree)
  std::int32_t turned_components = 0;    ///< closed components that were inside out and are turned as a whole
  std::vector<FaceId> inside_out_faces;  ///< the faces of those
  std::int32_t n_one_sided = 0;          ///< components that cannot be oriented (a Moebius strip); left as they are
};

/// Welds, orders and orients. Nodes: (entity dim, entity id, index); nodes without a triangle are omitted. Triangles:
/// (face, position in its patch). Triangles with a repeated node stay: check_topology() counts them. The
/// labels of the result are left empty. Orientation: faces that share a manifold edge are made to agree, the larger
/// area deciding; a closed component of negative volume is turned, unless it lies inside another closed one as a void
/// does (odd nesting depth). Throws Error(kInput) when a patch names an entity or node that does not exist, or a face
/// occurs twice. Linear time; at most 130 bytes per triangle besides the result and the input.
SurfaceMesh merge_patches(const MergeInput& input, OrientationReport& report);

/// The same, but triangles stay as they are in their patches.
SurfaceMesh weld_mesh(const MergeInput& input);

/// Describes the nodes on vertices and edges of a mesh that has places alone. node_previous is filled where `edges`
/// have it. Of `input` the patches are not used.
void describe_boundary(const MergeInput& input, const PatchNumbers& numbers, SurfaceMesh& mesh);
/// Likewise, after it, the nodes inside patch i, and its triangles.
void describe_patch(const MergeInput& input, const PatchNumbers& numbers, const FacePatch& p, std::size_t i,
                    SurfaceMesh& mesh);

/// The orientation step alone: turns triangles (and their corner uv, if any) of `mesh` in place.
OrientationReport orient_outward(SurfaceMesh& mesh);

}  // namespace st
