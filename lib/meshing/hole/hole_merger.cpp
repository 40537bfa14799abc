#include "meshing/hole/hole_merger.h"

#include <algorithm>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/sort_once.h"
#include "base/threads.h"
#include "mesh/corner_uv.h"
#include "mesh/merge.h"

namespace st {
namespace {

/// One face with what fills its holes. Its corners are boundary ids as -1 - id, and places among nodes inside: those of
/// the old mesh, then those of each fill.
class FilledFace {
 public:
  FilledFace(const HoleNumbering& numbering, const HoleMarks& marks, std::span<const Piece> fills, FaceId f)
      : numbering_(numbering),
        cad_(numbering.mesh),
        marks_(marks),
        fills_(fills),
        face_(f),
        first_old_(cad_.inner_begin[f]),
        n_old_(cad_.inner_begin[f + 1] - first_old_) {
    patch_.face = f;
    reserve();
  }

  FacePatch run() {
    for (TriangleId i = cad_.face_begin[face_]; i < cad_.face_begin[face_ + 1]; ++i)
      if (fills_.empty() || !marks_.triangle[i]) keep(i);
    for (const Piece& fill : fills_) add(fill);
    number_boundary();
    const std::span<const Vec2> uv = fills_.empty() ? old_uv() : uv_;
    number_inside(uv);
    set_corner_uvs(uv, patch_);
    return std::move(patch_);
  }

 private:
  void reserve() {
    std::size_t n_triangles = cad_.face_size(face_), n_inside = n_old_;
    for (const Piece& fill : fills_) n_triangles += fill.mesh.corners.size() / 3, n_inside += fill.mesh.inner.size();
    place_.assign(n_inside, kNone);
    patch_.triangles.reserve(n_triangles);
    patch_.triangle_previous.reserve(n_triangles);
    if (!fills_.empty()) uv_.reserve(3 * n_triangles);
  }

  std::span<const Vec2> old_uv() const {
    return std::span(cad_.mesh.corner_uv)
        .subspan(3 * static_cast<std::size_t>(cad_.face_begin[face_]), 3 * patch_.triangles.size());
  }

  NodeId on_boundary(std::int32_t id) {
    if (boundary_.empty() || boundary_.back() != id) boundary_.push_back(id);
    return -1 - id;
  }
  NodeId inside(std::int32_t place) {
    place_[place] = 0;
    return place;
  }

  NodeId kept_corner(NodeId n, TriangleId of) {
    if (n < cad_.inner_begin[0]) return on_boundary(numbering_.of_node[n]);
    if (n < first_old_ || n - first_old_ >= n_old_)
      throw Error(ExitCode::kInput, "triangle " + std::to_string(of + 1) + " of face " + std::to_string(face_ + 1) +
                                        " has a node inside another face; the mesh is damaged: make it again");
    return inside(n - first_old_);
  }

  void keep(TriangleId i) {
    const SurfaceMesh& old = cad_.mesh;
    const Triangle& t = old.triangles[i];
    patch_.triangles.push_back({{kept_corner(t.n[0], i), kept_corner(t.n[1], i), kept_corner(t.n[2], i)}});
    const Vec2* const uv = &old.corner_uv[3 * static_cast<std::size_t>(i)];
    for (int k = 0; k < 3 && !fills_.empty(); ++k) uv_.push_back(uv[k]);
    patch_.triangle_previous.push_back(i);
  }

  void add(const Piece& fill) {
    const std::vector<FaceNode>& rim = fill.boundary;
    const auto n_rim = static_cast<std::int32_t>(rim.size());
    const auto corner = [&](std::int32_t n) {
      uv_.push_back(n < n_rim ? rim[n].uv : fill.mesh.inner[n - n_rim].uv);
      if (n >= n_rim) return inside(n_old_ + n_new_ + n - n_rim);
      const std::int32_t id = rim[n].id;
      return numbering_.is_inner(id) ? inside(id - numbering_.number(first_old_)) : on_boundary(id);
    };
    const std::vector<std::int32_t>& c = fill.mesh.corners;
    for (std::size_t i = 0; i < c.size(); i += 3) {
      Triangle t{};
      for (int k = 0; k < 3; ++k) t.n[k] = corner(c[i + k]);
      patch_.triangles.push_back(t);
    }
    patch_.triangle_previous.resize(patch_.triangles.size(), kNone);
    n_new_ += static_cast<std::int32_t>(fill.mesh.inner.size());
  }

  void number_boundary() {
    sort_once(boundary_);
    for (const std::int32_t id : boundary_) {
      const BoundaryNumbering::Entity entity = numbering_.boundary.entity(id);
      patch_.boundary_dim.push_back(static_cast<std::uint8_t>(entity.dim));
      patch_.boundary_entity.push_back(entity.entity);
      patch_.boundary_index.push_back(entity.index);
    }
    patch_.n_boundary = static_cast<std::int32_t>(boundary_.size());
  }

  /// Those that a triangle has.
  void number_inside(std::span<const Vec2> corner_uv) {
    patch_.inner_xyz.reserve(place_.size());
    patch_.inner_size.reserve(place_.size());
    patch_.inner_previous.reserve(place_.size());
    std::int32_t i = 0;
    const auto add = [&](Vec3 x, double size, NodeId previous) {
      if (NodeId& place = place_[i++]; place != kNone) {
        place = patch_.n_boundary + static_cast<NodeId>(patch_.inner_xyz.size());
        patch_.inner_xyz.push_back(x);
        patch_.inner_size.push_back(size);
        patch_.inner_previous.push_back(previous);
      }
    };
    const SurfaceMesh& old = cad_.mesh;
    for (NodeId n = first_old_; n < first_old_ + n_old_; ++n) add(old.node_xyz[n], old.node_size[n], n);
    for (const Piece& fill : fills_)
      for (const FaceNode& n : fill.mesh.inner) add(n.x, n.h, kNone);
    patch_.inner_uv.resize(patch_.inner_xyz.size());
    const Vec2* uv = corner_uv.data();
    for (Triangle& t : patch_.triangles)
      for (NodeId& n : t.n) {
        if (n < 0) {
          n = static_cast<NodeId>(std::lower_bound(boundary_.begin(), boundary_.end(), -1 - n) - boundary_.begin());
        } else {
          n = place_[n];
          patch_.inner_uv[n - patch_.n_boundary] = *uv;
        }
        ++uv;
      }
  }

  const HoleNumbering& numbering_;
  const HoleMesh& cad_;
  const HoleMarks& marks_;
  const std::span<const Piece> fills_;
  const FaceId face_;
  const NodeId first_old_, n_old_;  // inside the face, of the old mesh
  FacePatch patch_;
  std::vector<Vec2> uv_;                // of all corners, where there are fills
  std::int32_t n_new_ = 0;              // nodes of the fills that were added
  std::vector<std::int32_t> boundary_;  // ids; then ascending, once each
  std::vector<NodeId> place_;           // of nodes inside, in the patch; kNone: no triangle has it
};

}  // namespace

std::vector<FacePatch> insert_fills(const HoleNumbering& numbering, const HoleMarks& marks,
                                    std::span<const std::vector<Piece>> fills, std::span<const FaceId> left_out) {
  std::vector<FacePatch> patches(fills.size());
  parallel_for(fills.size(), 1, [&](std::size_t i, std::size_t) {
    const auto f = static_cast<FaceId>(i);
    if (std::binary_search(left_out.begin(), left_out.end(), f))
      patches[i].face = f;
    else
      patches[i] = FilledFace(numbering, marks, fills[i], f).run();
  });
  return patches;
}

SurfaceMesh weld_filled(const HoleNumbering& numbering, std::span<const FacePatch> patches) {
  const HoleMesh& cad = numbering.mesh;
  std::vector<std::int32_t> group(patches.size(), 0);
  for (std::size_t f = 0; f < group.size(); ++f)
    if (cad.face_size(static_cast<FaceId>(f)) > 0) group[f] = cad.mesh.triangle_group[cad.face_begin[f]];
  SurfaceMesh mesh =
      weld_mesh({numbering.update.edges, cad.tables.vertex_xyz, cad.tables.edge_vertices, patches, group});
  mesh.labels = cad.mesh.labels;
  return mesh;
}

}  // namespace st
