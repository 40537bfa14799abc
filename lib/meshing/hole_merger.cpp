#include "meshing/hole_merger.h"

#include <algorithm>

namespace st {
namespace {

class Inserter {
 public:
  Inserter(const HoleNumbering& numbering, std::span<const FacePatch> redone)
      : numbering_(numbering), cad_(numbering.mesh), old_(cad_.mesh), edges_(numbering.update.edges), redone_(redone) {}

  SurfaceMesh run() {
    mark_used();
    reserve();
    add_vertices();
    add_edges();
    for (FaceId f = 0; f < n_faces(); ++f) is_redone(f) ? insert(redone_[f]) : copy(f);
    mesh_.face_name = old_.face_name;
    mesh_.group_name = old_.group_name;
    return std::move(mesh_);
  }

 private:
  FaceId n_faces() const { return cad_.tables.n_faces(); }
  bool is_redone(FaceId f) const { return !redone_[f].triangles.empty(); }
  std::int32_t number(const FacePatch& p, std::int32_t i) const {
    if (p.boundary_dim[i] == static_cast<std::uint8_t>(EntityDim::kVertex)) return numbering_.boundary.vertex(p.boundary_entity[i]);
    return numbering_.boundary.edge_node(p.boundary_entity[i], p.boundary_index[i]);
  }

  /// Boundary nodes that have a triangle.
  void mark_used() {
    place_.assign(numbering_.first_inner, kNone);
    for (FaceId f = 0; f < n_faces(); ++f) {
      if (is_redone(f)) {
        const FacePatch& p = redone_[f];
        for (const Triangle& t : p.triangles)
          for (NodeId n : t.n)
            if (n < p.n_boundary) place_[number(p, n)] = 0;
        continue;
      }
      for (TriangleId i = cad_.face_begin[f]; i < cad_.face_begin[f + 1]; ++i)
        for (NodeId n : old_.triangles[i].n)
          if (n < cad_.inner_begin[0]) place_[numbering_.of_node[n]] = 0;
    }
  }

  void reserve() {
    std::size_t n_nodes = std::count(place_.begin(), place_.end(), 0), n_triangles = 0;
    for (FaceId f = 0; f < n_faces(); ++f) {
      n_nodes += is_redone(f) ? redone_[f].inner_xyz.size() : cad_.inner_begin[f + 1] - cad_.inner_begin[f];
      n_triangles += is_redone(f) ? redone_[f].triangles.size() : cad_.face_size(f);
    }
    mesh_.node_xyz.reserve(n_nodes);
    mesh_.node_entity_dim.reserve(n_nodes);
    mesh_.node_entity.reserve(n_nodes);
    mesh_.node_t.reserve(n_nodes);
    mesh_.node_size.reserve(n_nodes);
    mesh_.node_previous.reserve(n_nodes);
    mesh_.triangles.reserve(n_triangles);
    mesh_.triangle_face.reserve(n_triangles);
    mesh_.triangle_group.reserve(n_triangles);
    mesh_.triangle_previous.reserve(n_triangles);
    mesh_.corner_uv.reserve(3 * n_triangles);
  }

  NodeId add(Vec3 x, EntityDim dim, std::int32_t entity, double t, double size, NodeId previous) {
    mesh_.node_xyz.push_back(x);
    mesh_.node_entity_dim.push_back(static_cast<std::uint8_t>(dim));
    mesh_.node_entity.push_back(entity);
    mesh_.node_t.push_back(t);
    mesh_.node_size.push_back(size);
    mesh_.node_previous.push_back(previous);
    return static_cast<NodeId>(mesh_.node_xyz.size()) - 1;
  }

  /// Their length is that of the edge of lowest id that ends there.
  void add_vertices() {
    const ModelTables& t = cad_.tables;
    std::vector<std::int32_t> end(t.n_vertices(), kNone);  // into edges_.node_*
    for (EdgeId e = t.n_edges() - 1; e >= 0; --e) {
      if (edges_.edge_offsets[e] == edges_.edge_offsets[e + 1]) continue;
      end[t.edge_vertices[2 * e + 1]] = edges_.edge_offsets[e + 1] - 1;
      end[t.edge_vertices[2 * e]] = edges_.edge_offsets[e];
    }
    for (VertexId v = 0; v < t.n_vertices(); ++v)
      if (NodeId& place = place_[numbering_.boundary.vertex(v)]; place != kNone)
        place = add(t.vertex_xyz[v], EntityDim::kVertex, v, 0,
                    end[v] == kNone ? old_.node_size[cad_.vertex_node[v]] : edges_.node_request[end[v]], cad_.vertex_node[v]);
  }

  void add_edges() {
    for (EdgeId e = 0; e < cad_.tables.n_edges(); ++e)
      for (std::int32_t begin = edges_.edge_offsets[e], i = begin + 1; i + 1 < edges_.edge_offsets[e + 1]; ++i)
        if (NodeId& place = place_[numbering_.boundary.edge_node(e, i - begin)]; place != kNone)
          place = add(edges_.node_xyz[i], EntityDim::kEdge, e, edges_.node_t[i], edges_.node_request[i], edges_.node_previous[i]);
  }

  /// A face as it was: all its arrays lie together, before and after.
  void copy(FaceId f) {
    const auto append = [](auto& to, const auto& from, std::ptrdiff_t begin, std::ptrdiff_t end) {
      to.insert(to.end(), from.begin() + begin, from.begin() + end);
    };
    const NodeId first = cad_.inner_begin[f], last = cad_.inner_begin[f + 1], shift = static_cast<NodeId>(mesh_.node_xyz.size()) - first;
    append(mesh_.node_xyz, old_.node_xyz, first, last);
    append(mesh_.node_entity_dim, old_.node_entity_dim, first, last);
    append(mesh_.node_entity, old_.node_entity, first, last);
    append(mesh_.node_t, old_.node_t, first, last);
    append(mesh_.node_size, old_.node_size, first, last);
    for (NodeId n = first; n < last; ++n) mesh_.node_previous.push_back(n);
    const TriangleId begin = cad_.face_begin[f], end = cad_.face_begin[f + 1];
    append(mesh_.triangle_face, old_.triangle_face, begin, end);
    append(mesh_.triangle_group, old_.triangle_group, begin, end);
    append(mesh_.corner_uv, old_.corner_uv, 3 * static_cast<std::ptrdiff_t>(begin), 3 * static_cast<std::ptrdiff_t>(end));
    for (TriangleId i = begin; i < end; ++i) {
      Triangle t = old_.triangles[i];
      for (NodeId& n : t.n) n = n < cad_.inner_begin[0] ? place_[numbering_.of_node[n]] : n + shift;
      mesh_.triangles.push_back(t);
      mesh_.triangle_previous.push_back(i);
    }
  }

  void insert(const FacePatch& p) {
    std::vector<NodeId> place(p.n_boundary + p.inner_xyz.size(), kNone);
    for (const Triangle& t : p.triangles)
      for (NodeId n : t.n) place[n] = 0;
    for (std::int32_t i = 0; i < p.n_boundary; ++i) place[i] = place_[number(p, i)];
    for (std::size_t i = 0; i < p.inner_xyz.size(); ++i)
      if (NodeId& n = place[p.n_boundary + i]; n != kNone)
        n = add(p.inner_xyz[i], EntityDim::kFace, p.face, 0, p.inner_size[i], p.inner_previous[i]);
    for (const Triangle& t : p.triangles) mesh_.triangles.push_back({{place[t.n[0]], place[t.n[1]], place[t.n[2]]}});
    mesh_.corner_uv.insert(mesh_.corner_uv.end(), p.corner_uv.begin(), p.corner_uv.end());
    mesh_.triangle_previous.insert(mesh_.triangle_previous.end(), p.triangle_previous.begin(), p.triangle_previous.end());
    mesh_.triangle_face.insert(mesh_.triangle_face.end(), p.triangles.size(), p.face);
    mesh_.triangle_group.insert(mesh_.triangle_group.end(), p.triangles.size(), old_.triangle_group[cad_.face_begin[p.face]]);
  }

  const HoleNumbering& numbering_;
  const HoleMesh& cad_;
  const SurfaceMesh& old_;
  const EdgeMesh& edges_;
  std::span<const FacePatch> redone_;
  std::vector<NodeId> place_;  // [first_inner] in the new mesh, by number of boundary nodes
  SurfaceMesh mesh_;
};

}  // namespace

SurfaceMesh insert_patches(const HoleNumbering& numbering, std::span<const FacePatch> redone) { return Inserter(numbering, redone).run(); }

}  // namespace st
