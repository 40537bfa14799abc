// One mesh from the patches of all faces: welded by ids, oriented out of the solid, in canonical order.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/assert.h"
#include "mesh/surface_mesh.h"

namespace st {

/// Number of a node on a vertex (itself) or on an edge: all vertices, then all edges.node_*. The ends of edges are
/// vertices and have no number there.
inline std::int32_t boundary_id(VertexId n_vertices, const EdgeMesh& edges, EdgeId e, std::int32_t index) {
  return n_vertices + edges.first_node(e) + index;
}

/// The same number of a boundary node of a patch.
std::int32_t boundary_id_of(VertexId n_vertices, const EdgeMesh& edges, const FacePatch& p, std::int32_t boundary_node);

/// Patches joined by the ids of their nodes: places and corners, and where they come from.
struct WeldedPatches {
  std::vector<Vec3> points;             ///< by (entity dim, entity id, index); only those that a triangle uses
  std::vector<Triangle> triangles;      ///< by (patch, position in it)
  std::vector<TriangleId> patch_begin;  ///< [n_patches+1] into triangles
  std::vector<NodeId> boundary;         ///< [n_vertices + edges.node_t] node by boundary_id; kNone: no triangle uses it
  NodeId n_boundary = 0;                ///< nodes on vertices and edges; those inside faces follow
  std::vector<std::int32_t> inner;      ///< [points - n_boundary] node inside a face: its place in FacePatch::inner_*
  std::vector<std::int32_t> inner_begin;  ///< [n_patches+1] into inner
};

/// Numbers the nodes of one mesh: use() of all nodes on vertices and edges that its triangles have, number_boundary(),
/// then face by face the nodes and triangles inside. The references outlive it.
class Welder {
 public:
  Welder(const EdgeMesh& edges, std::span<const Vec3> vertex_xyz);
  void use(std::int32_t boundary_id) {
    ST_ASSERT(boundary_id >= 0 && boundary_id < static_cast<std::int64_t>(welded_.boundary.size()));
    welded_.boundary[boundary_id] = 0;
  }
  /// Makes room for so many more. Throws Error when the mesh has more than ids can count.
  void number_boundary(std::size_t n_inner, std::size_t n_triangles);
  NodeId boundary(std::int32_t boundary_id) const { return welded_.boundary[boundary_id]; }
  NodeId add_point(Vec3 x) {
    welded_.points.push_back(x);
    return static_cast<NodeId>(welded_.points.size()) - 1;
  }
  void add_triangle(NodeId a, NodeId b, NodeId c) { welded_.triangles.push_back({{a, b, c}}); }
  std::int32_t id_of(const FacePatch& p, std::int32_t boundary_node) const;
  const WeldedPatches& welded() const { return welded_; }
  WeldedPatches take() { return std::move(welded_); }

 private:
  const EdgeMesh& edges_;
  std::span<const Vec3> vertex_xyz_;
  WeldedPatches welded_;
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

/// What a mesh says of its next node.
void describe_node(SurfaceMesh& mesh, EntityDim dim, std::int32_t entity, double t, double size);

/// A mesh with room for what is welded, in which its nodes on vertices and edges are described. node_previous is filled
/// where `edges` have it. Of `input` the patches are not used.
SurfaceMesh describe_boundary(const MergeInput& input, const WeldedPatches& welded);

/// The patches that merge_patches() makes the mesh of, by face ([n_faces]); without triangles where the mesh has none.
/// `edges`: those of the mesh.
std::vector<FacePatch> split_patches(const SurfaceMesh& mesh, const EdgeMesh& edges, FaceId n_faces);

/// The orientation step alone: turns triangles (and their corner uv, if any) of `mesh` in place.
OrientationReport orient_outward(SurfaceMesh& mesh);

}  // namespace st
