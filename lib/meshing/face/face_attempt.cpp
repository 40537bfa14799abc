#include "meshing/face/face_attempt.h"

#include <algorithm>

namespace st {
namespace {

constexpr std::size_t kMaxTriangles = 200000;  // of the partial state: enough to look at

/// All coedges of the face by edge: which loop an edge belongs to. Seams and slits belong to one loop twice.
struct LoopEdge {
  EdgeId edge;
  std::int32_t loop;
};

std::vector<LoopEdge> loop_edges(const ModelTables& t, FaceId face) {
  std::vector<LoopEdge> list;
  for (const LoopId l : t.loops(face))
    for (const CoedgeId c : t.loop_coedges(l)) list.push_back({t.coedge_edge[c], l - t.loops(face).first()});
  return list;
}

/// The face's edge that a segment lies on: that of its inner node, else the one between its two vertices.
LoopEdge edge_of(const BoundaryNumbering& numbering, const std::vector<LoopEdge>& edges, std::int32_t id_a,
                 std::int32_t id_b) {
  const ModelTables& t = numbering.tables;
  const auto a = numbering.entity(id_a), b = numbering.entity(id_b);
  const auto fits = [&](const LoopEdge& e) {
    if (a.dim == EntityDim::kEdge) return e.edge == a.entity;
    if (b.dim == EntityDim::kEdge) return e.edge == b.entity;
    const auto ends = std::minmax(t.edge_vertices[2 * e.edge], t.edge_vertices[2 * e.edge + 1]);
    return ends == std::minmax(a.entity, b.entity);
  };
  const auto found = std::find_if(edges.begin(), edges.end(), fits);
  return found == edges.end() ? LoopEdge{kNone, 0} : *found;
}

void add_node(const FaceNode& n, FacePatch& patch) {
  patch.inner_xyz.push_back(n.x);
  patch.inner_uv.push_back(n.uv);
  patch.inner_size.push_back(n.h);
}

void add_boundary(const BoundaryNumbering& numbering, const FaceBoundary& boundary, FaceAttempt& f) {
  const std::vector<LoopEdge> edges = loop_edges(numbering.tables, f.face());
  for (const FaceNode& n : boundary.nodes) add_node(n, f.patch);
  for (const auto& [a, b] : boundary.segments) {
    const LoopEdge e = edge_of(numbering, edges, boundary.nodes[a].id, boundary.nodes[b].id);
    f.segment_nodes.insert(f.segment_nodes.end(), {a, b});
    f.segment_loop.push_back(e.loop);
    f.segment_edge.push_back(e.edge);
  }
}

void add_triangles(const FaceMesh& mesh, FacePatch& patch) {
  for (const FaceNode& n : mesh.inner) add_node(n, patch);
  for (std::size_t i = 0; i + 2 < mesh.corners.size() && patch.triangles.size() < kMaxTriangles; i += 3) {
    const std::int32_t* c = &mesh.corners[i];
    if (c[0] != kNone && c[1] != kNone && c[2] != kNone) patch.triangles.push_back({{c[0], c[1], c[2]}});
  }
}

}  // namespace

FaceAttempt describe_attempt(const BoundaryNumbering& numbering, FaceId face, const FaceBoundary& boundary,
                             const FaceMesh& mesh) {
  FaceAttempt f;
  f.patch.face = face;
  const bool has_uv = !boundary.nodes.empty();
  add_boundary(numbering, has_uv ? boundary : make_boundary_in_space(face, numbering), f);
  if (has_uv) add_triangles(mesh, f.patch);
  for (const RefinementPoint& p : mesh.refinement) f.places.push_back(p.x);
  return f;
}

}  // namespace st
