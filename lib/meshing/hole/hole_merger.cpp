#include "meshing/hole/hole_merger.h"

#include <algorithm>

#include "base/limits.h"

namespace st {
namespace {

class Inserter {
 public:
  Inserter(const HoleNumbering& numbering, const HoleMarks& marks, std::span<const std::vector<HoleFill>> fills)
      : numbering_(numbering),
        marks_(marks),
        cad_(numbering.mesh),
        old_(cad_.mesh),
        edges_(numbering.update.edges),
        fills_(fills) {}

  SurfaceMesh run() {
    mark_used();
    reserve();
    add_vertices();
    add_edges();
    for (FaceId f = 0; f < n_faces(); ++f) is_redone(f) ? insert(f) : copy(f);
    mesh_.face_name = old_.face_name;
    mesh_.group_name = old_.group_name;
    mesh_.group_role = old_.group_role;
    mesh_.labels = old_.labels;
    return std::move(mesh_);
  }

 private:
  FaceId n_faces() const { return cad_.tables.n_faces(); }
  bool is_redone(FaceId f) const { return !fills_[f].empty(); }
  bool is_kept(TriangleId i) const { return !is_redone(old_.triangle_face[i]) || !marks_.triangle[i]; }

  /// Boundary nodes that have a triangle.
  void mark_used() {
    place_.assign(numbering_.first_inner, kNone);
    for (FaceId f = 0; f < n_faces(); ++f) {
      for (TriangleId i = cad_.face_begin[f]; i < cad_.face_begin[f + 1]; ++i)
        for (NodeId n : old_.triangles[i].n)
          if (n < cad_.inner_begin[0] && is_kept(i)) place_[numbering_.of_node[n]] = 0;
      for (const HoleFill& fill : fills_[f])
        for (const Triangle& t : fill.triangles)
          for (NodeId n : t.n)
            if (const std::int32_t id = fill.nodes[n].id; id != kNone && !numbering_.is_inner(id)) place_[id] = 0;
    }
  }

  void reserve() {
    std::size_t n_nodes = std::count(place_.begin(), place_.end(), 0), n_triangles = 0;
    for (FaceId f = 0; f < n_faces(); ++f) {
      n_nodes += cad_.inner_begin[f + 1] - cad_.inner_begin[f];
      n_triangles += cad_.face_size(f);
      for (const HoleFill& fill : fills_[f]) {
        n_nodes += fill.nodes.size();
        n_triangles += fill.triangles.size();
      }
    }
    require_countable(n_nodes, "nodes of the old and the new mesh");
    require_countable(n_triangles, "triangles of the old and the new mesh", kMaxTriangles);
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
      if (edges_.n_nodes(e) == 0) continue;
      end[t.edge_vertices[2 * e + 1]] = edges_.first_node(e) + edges_.n_nodes(e) - 1;
      end[t.edge_vertices[2 * e]] = edges_.first_node(e);
    }
    for (VertexId v = 0; v < t.n_vertices(); ++v)
      if (NodeId& place = place_[numbering_.boundary.vertex(v)]; place != kNone)
        place = add(t.vertex_xyz[v], EntityDim::kVertex, v, 0,
                    end[v] == kNone ? old_.node_size[cad_.vertex_node[v]] : edges_.node_request[end[v]],
                    cad_.vertex_node[v]);
  }

  void add_edges() {
    for (EdgeId e = 0; e < cad_.tables.n_edges(); ++e)
      for (std::int32_t begin = edges_.first_node(e), i = begin + 1; i + 1 < begin + edges_.n_nodes(e); ++i)
        if (NodeId& place = place_[numbering_.boundary.edge_node(e, i - begin)]; place != kNone)
          place = add(edges_.node_xyz[i], EntityDim::kEdge, e, edges_.node_t[i], edges_.node_request[i],
                      edges_.node_previous[i]);
  }

  /// A face as it was: all its arrays lie together, before and after.
  void copy(FaceId f) {
    const auto append = [](auto& to, const auto& from, std::ptrdiff_t begin, std::ptrdiff_t end) {
      to.insert(to.end(), from.begin() + begin, from.begin() + end);
    };
    const NodeId first = cad_.inner_begin[f], last = cad_.inner_begin[f + 1],
                 shift = static_cast<NodeId>(mesh_.node_xyz.size()) - first;
    append(mesh_.node_xyz, old_.node_xyz, first, last);
    append(mesh_.node_entity_dim, old_.node_entity_dim, first, last);
    append(mesh_.node_entity, old_.node_entity, first, last);
    append(mesh_.node_t, old_.node_t, first, last);
    append(mesh_.node_size, old_.node_size, first, last);
    for (NodeId n = first; n < last; ++n) mesh_.node_previous.push_back(n);
    const TriangleId begin = cad_.face_begin[f], end = cad_.face_begin[f + 1];
    append(mesh_.triangle_face, old_.triangle_face, begin, end);
    append(mesh_.triangle_group, old_.triangle_group, begin, end);
    append(mesh_.corner_uv, old_.corner_uv, 3 * static_cast<std::ptrdiff_t>(begin),
           3 * static_cast<std::ptrdiff_t>(end));
    for (TriangleId i = begin; i < end; ++i) {
      Triangle t = old_.triangles[i];
      for (NodeId& n : t.n) n = n < cad_.inner_begin[0] ? place_[numbering_.of_node[n]] : n + shift;
      mesh_.triangles.push_back(t);
      mesh_.triangle_previous.push_back(i);
    }
  }

  void insert(FaceId f) {
    add_kept_nodes(f);
    for (TriangleId i = cad_.face_begin[f]; i < cad_.face_begin[f + 1]; ++i) {
      if (marks_.triangle[i]) continue;
      Triangle t = old_.triangles[i];
      for (NodeId& n : t.n) n = placed(numbering_.number(n));
      mesh_.triangles.push_back(t);
      for (int k = 0; k < 3; ++k) mesh_.corner_uv.push_back(old_.corner_uv[3 * i + k]);
      mesh_.triangle_previous.push_back(i);
    }
    for (const HoleFill& fill : fills_[f]) add_fill(fill, f);
    const std::size_t n_new = mesh_.triangles.size() - mesh_.triangle_face.size();
    mesh_.triangle_face.insert(mesh_.triangle_face.end(), n_new, f);
    mesh_.triangle_group.insert(mesh_.triangle_group.end(), n_new, old_.triangle_group[cad_.face_begin[f]]);
  }

  /// Nodes inside a redone face that have a triangle.
  void add_kept_nodes(FaceId f) {
    first_id_ = numbering_.number(cad_.inner_begin[f]);
    inner_place_.assign(cad_.inner_begin[f + 1] - cad_.inner_begin[f], kNone);
    for (TriangleId i = cad_.face_begin[f]; i < cad_.face_begin[f + 1]; ++i)
      for (NodeId n : old_.triangles[i].n)
        if (n >= cad_.inner_begin[f] && !marks_.triangle[i]) inner_place_[n - cad_.inner_begin[f]] = 0;
    for (const HoleFill& fill : fills_[f])
      for (const Triangle& t : fill.triangles)
        for (NodeId n : t.n)
          if (const std::int32_t id = fill.nodes[n].id; numbering_.is_inner(id)) inner_place_[id - first_id_] = 0;
    for (NodeId n = cad_.inner_begin[f]; n < cad_.inner_begin[f + 1]; ++n)
      if (NodeId& place = inner_place_[n - cad_.inner_begin[f]]; place != kNone)
        place = add(old_.node_xyz[n], EntityDim::kFace, f, 0, old_.node_size[n], n);
  }

  NodeId placed(std::int32_t id) const { return numbering_.is_inner(id) ? inner_place_[id - first_id_] : place_[id]; }

  void add_fill(const HoleFill& fill, FaceId f) {
    std::vector<NodeId> place(fill.nodes.size(), kNone);
    for (const Triangle& t : fill.triangles)
      for (NodeId n : t.n) place[n] = 0;
    for (std::size_t i = 0; i < place.size(); ++i)
      if (const FaceNode& n = fill.nodes[i]; place[i] != kNone)
        place[i] = n.id == kNone ? add(n.x, EntityDim::kFace, f, 0, n.h, kNone) : placed(n.id);
    for (const Triangle& t : fill.triangles) {
      mesh_.triangles.push_back({{place[t.n[0]], place[t.n[1]], place[t.n[2]]}});
      for (NodeId n : t.n) mesh_.corner_uv.push_back(fill.nodes[n].uv);
    }
    mesh_.triangle_previous.resize(mesh_.triangles.size(), kNone);
  }

  const HoleNumbering& numbering_;
  const HoleMarks& marks_;
  const HoleMesh& cad_;
  const SurfaceMesh& old_;
  const EdgeMesh& edges_;
  std::span<const std::vector<HoleFill>> fills_;
  std::vector<NodeId> place_;        // [first_inner] in the new mesh, by number of boundary nodes
  std::vector<NodeId> inner_place_;  // likewise of the nodes inside the present face,
  std::int32_t first_id_ = 0;        // from this number
  SurfaceMesh mesh_;
};

}  // namespace

SurfaceMesh insert_fills(const HoleNumbering& numbering, const HoleMarks& marks,
                         std::span<const std::vector<HoleFill>> fills) {
  return Inserter(numbering, marks, fills).run();
}

}  // namespace st
