#include "meshing/hole/hole_merger.h"

#include <algorithm>

#include "mesh/merge.h"

namespace st {
namespace {

class Inserter {
 public:
  Inserter(const HoleNumbering& numbering, const HoleMarks& marks, std::span<const std::vector<FaceMesh>> fills,
           std::span<const FaceId> left_out)
      : numbering_(numbering),
        marks_(marks),
        cad_(numbering.mesh),
        old_(cad_.mesh),
        edges_(numbering.update.edges),
        fills_(fills),
        welder_(edges_, cad_.tables.vertex_xyz) {
    for (FaceId f = 0; f < cad_.tables.n_faces(); ++f)
      if (!std::binary_search(left_out.begin(), left_out.end(), f)) faces_.push_back(f);
  }

  SurfaceMesh run() {
    number_boundary();
    for (const FaceId f : faces_) is_redone(f) ? insert(f) : copy(f);
    WeldedPatches welded = welder_.take();
    mesh_.node_xyz = std::move(welded.points);
    mesh_.triangles = std::move(welded.triangles);
    mesh_.labels = old_.labels;
    return std::move(mesh_);
  }

 private:
  bool is_redone(FaceId f) const { return !fills_[f].empty(); }
  bool is_kept(TriangleId i) const { return !is_redone(old_.triangle_face[i]) || !marks_.triangle[i]; }

  void number_boundary() {
    std::size_t n_inner = 0, n_triangles = 0;
    for (const FaceId f : faces_) {
      n_inner += cad_.inner_begin[f + 1] - cad_.inner_begin[f];
      n_triangles += cad_.face_size(f);
      for (TriangleId i = cad_.face_begin[f]; i < cad_.face_begin[f + 1]; ++i)
        for (NodeId n : old_.triangles[i].n)
          if (n < cad_.inner_begin[0] && is_kept(i)) welder_.use(numbering_.of_node[n]);
      for (const FaceMesh& fill : fills_[f]) {
        n_inner += fill.inner.size();
        n_triangles += fill.corners.size() / 3;
        for (const std::int32_t n : fill.corners)
          if (const std::int32_t id = fill.inner[n].id; id != kNone && !numbering_.is_inner(id)) welder_.use(id);
      }
    }
    welder_.number_boundary(n_inner, n_triangles);
    const ModelTables& t = cad_.tables;
    mesh_ = describe_boundary({edges_, t.vertex_xyz, t.edge_vertices, {}, {}}, welder_.welded());
  }

  NodeId add(Vec3 x, FaceId f, double size, NodeId previous) {
    describe_node(mesh_, EntityDim::kFace, f, 0, size);
    mesh_.node_previous.push_back(previous);
    return welder_.add_point(x);
  }

  /// A face as it was: all its arrays lie together, before and after.
  void copy(FaceId f) {
    const auto append = [](auto& to, const auto& from, std::ptrdiff_t begin, std::ptrdiff_t end) {
      to.insert(to.end(), from.begin() + begin, from.begin() + end);
    };
    const NodeId first = cad_.inner_begin[f], last = cad_.inner_begin[f + 1],
                 shift = static_cast<NodeId>(welder_.welded().points.size()) - first;
    for (NodeId n = first; n < last; ++n) add(old_.node_xyz[n], f, old_.node_size[n], n);
    const TriangleId begin = cad_.face_begin[f], end = cad_.face_begin[f + 1];
    append(mesh_.triangle_face, old_.triangle_face, begin, end);
    append(mesh_.triangle_group, old_.triangle_group, begin, end);
    append(mesh_.corner_uv, old_.corner_uv, 3 * static_cast<std::ptrdiff_t>(begin),
           3 * static_cast<std::ptrdiff_t>(end));
    for (TriangleId i = begin; i < end; ++i) {
      const auto placed = [&](NodeId n) {
        return n < cad_.inner_begin[0] ? welder_.boundary(numbering_.of_node[n]) : n + shift;
      };
      const Triangle& t = old_.triangles[i];
      welder_.add_triangle(placed(t.n[0]), placed(t.n[1]), placed(t.n[2]));
      mesh_.triangle_previous.push_back(i);
    }
  }

  void insert(FaceId f) {
    add_kept_nodes(f);
    for (TriangleId i = cad_.face_begin[f]; i < cad_.face_begin[f + 1]; ++i) {
      if (marks_.triangle[i]) continue;
      const Triangle& t = old_.triangles[i];
      const auto new_node = [&](NodeId n) { return placed(numbering_.number(n)); };
      welder_.add_triangle(new_node(t.n[0]), new_node(t.n[1]), new_node(t.n[2]));
      for (int k = 0; k < 3; ++k) mesh_.corner_uv.push_back(old_.corner_uv[3 * i + k]);
      mesh_.triangle_previous.push_back(i);
    }
    for (const FaceMesh& fill : fills_[f]) add_fill(fill, f);
    const std::size_t n_new = mesh_.triangle_previous.size() - mesh_.triangle_face.size();
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
    for (const FaceMesh& fill : fills_[f])
      for (const std::int32_t n : fill.corners)
        if (const std::int32_t id = fill.inner[n].id; numbering_.is_inner(id)) inner_place_[id - first_id_] = 0;
    for (NodeId n = cad_.inner_begin[f]; n < cad_.inner_begin[f + 1]; ++n)
      if (NodeId& place = inner_place_[n - cad_.inner_begin[f]]; place != kNone)
        place = add(old_.node_xyz[n], f, old_.node_size[n], n);
  }

  NodeId placed(std::int32_t id) const {
    return numbering_.is_inner(id) ? inner_place_[id - first_id_] : welder_.boundary(id);
  }

  void add_fill(const FaceMesh& fill, FaceId f) {
    const std::vector<std::int32_t>& corners = fill.corners;
    std::vector<NodeId> place(fill.inner.size(), kNone);
    for (const std::int32_t n : corners) place[n] = 0;
    for (std::size_t i = 0; i < place.size(); ++i)
      if (const FaceNode& n = fill.inner[i]; place[i] != kNone)
        place[i] = n.id == kNone ? add(n.x, f, n.h, kNone) : placed(n.id);
    for (std::size_t i = 0; i < corners.size(); i += 3)
      welder_.add_triangle(place[corners[i]], place[corners[i + 1]], place[corners[i + 2]]);
    for (const std::int32_t n : corners) mesh_.corner_uv.push_back(fill.inner[n].uv);
    mesh_.triangle_previous.resize(mesh_.triangle_previous.size() + corners.size() / 3, kNone);
  }

  const HoleNumbering& numbering_;
  const HoleMarks& marks_;
  const HoleMesh& cad_;
  const SurfaceMesh& old_;
  const EdgeMesh& edges_;
  std::span<const std::vector<FaceMesh>> fills_;
  std::vector<FaceId> faces_;
  Welder welder_;
  std::vector<NodeId> inner_place_;  // in the new mesh, of the nodes inside the present face,
  std::int32_t first_id_ = 0;        // from this number
  SurfaceMesh mesh_;
};

}  // namespace

SurfaceMesh insert_fills(const HoleNumbering& numbering, const HoleMarks& marks,
                         std::span<const std::vector<FaceMesh>> fills, std::span<const FaceId> left_out) {
  return Inserter(numbering, marks, fills, left_out).run();
}

}  // namespace st
