#include "meshing/hole/hole_merger.h"

#include <algorithm>
#include <numeric>
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

  [[noreturn]] void throw_strange_node(TriangleId of) const {
    throw Error(ExitCode::kInput, "triangle " + std::to_string(of + 1) + " of face " + std::to_string(face_ + 1) +
                                      " has a node inside another face; the mesh is damaged: make it again");
  }

  NodeId kept_corner(NodeId n, TriangleId of) {
    if (n < cad_.inner_begin[0]) return on_boundary(numbering_.of_node[n]);
    if (n < first_old_ || n - first_old_ >= n_old_) throw_strange_node(of);
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

/// A face that is as it was: it goes from mesh to mesh without a patch, by its numbers there.
class OldFace {
 public:
  OldFace(const HoleNumbering& numbering, FaceId f) : numbering_(numbering), cad_(numbering.mesh), face_(f) {}

  PatchUse use() const {
    PatchUse use{{}, cad_.inner_begin[face_ + 1] - cad_.inner_begin[face_], cad_.face_size(face_)};
    for (TriangleId i = cad_.face_begin[face_]; i < cad_.face_begin[face_ + 1]; ++i)
      for (const NodeId n : cad_.mesh.triangles[i].n)
        if (n < cad_.inner_begin[0]) use.boundary.push_back(numbering_.of_node[n]);
    return use;
  }

  void copy_to(const PatchNumbers& numbers, SurfaceMesh& mesh) const {
    const SurfaceMesh& old = cad_.mesh;
    const NodeId first = cad_.inner_begin[face_], end = cad_.inner_begin[face_ + 1], to = numbers.inner_begin[face_];
    const auto copy = [](const auto& from, std::ptrdiff_t begin, std::ptrdiff_t end, auto& into, std::ptrdiff_t at) {
      std::copy(from.begin() + begin, from.begin() + end, into.begin() + at);
    };
    copy(old.node_xyz, first, end, mesh.node_xyz, to);
    copy(old.node_size, first, end, mesh.node_size, to);
    copy(old.node_entity_dim, first, end, mesh.node_entity_dim, to);
    copy(old.node_entity, first, end, mesh.node_entity, to);
    std::iota(mesh.node_previous.begin() + to, mesh.node_previous.begin() + to + (end - first), first);
    const std::ptrdiff_t begin = cad_.face_begin[face_], last = cad_.face_begin[face_ + 1],
                         at = numbers.triangle_begin[face_];
    copy(old.triangle_face, begin, last, mesh.triangle_face, at);
    copy(old.triangle_group, begin, last, mesh.triangle_group, at);
    copy(old.corner_uv, 3 * begin, 3 * last, mesh.corner_uv, 3 * at);
    std::iota(mesh.triangle_previous.begin() + at, mesh.triangle_previous.begin() + at + (last - begin),
              static_cast<TriangleId>(begin));
    for (std::ptrdiff_t i = begin; i < last; ++i)
      for (int k = 0; k < 3; ++k) {
        const NodeId n = old.triangles[i].n[k];
        mesh.triangles[at + i - begin].n[k] =
            n < cad_.inner_begin[0] ? numbers.boundary[numbering_.of_node[n]] : n - first + to;
      }
  }

 private:
  const HoleNumbering& numbering_;
  const HoleMesh& cad_;
  const FaceId face_;
};

}  // namespace

std::vector<FacePatch> insert_fills(const HoleNumbering& numbering, const HoleMarks& marks,
                                    std::span<const std::vector<Piece>> fills) {
  std::vector<FacePatch> patches(fills.size());
  parallel_for(fills.size(), 1, [&](std::size_t f, std::size_t) {
    if (!fills[f].empty()) patches[f] = FilledFace(numbering, marks, fills[f], static_cast<FaceId>(f)).run();
  });
  return patches;
}

void add_old_patches(const HoleNumbering& numbering, std::span<const FaceId> left_out,
                     std::vector<FacePatch>& patches) {
  const HoleMarks none;
  parallel_for(patches.size(), 1, [&](std::size_t i, std::size_t) {
    const auto f = static_cast<FaceId>(i);
    if (std::binary_search(left_out.begin(), left_out.end(), f)) {
      patches[i] = FacePatch();
      patches[i].face = f;
    } else if (patches[i].face == kNone) {
      patches[i] = FilledFace(numbering, none, {}, f).run();
    }
  });
}

SurfaceMesh weld_filled(const HoleNumbering& numbering, std::span<const FacePatch> patches) {
  const HoleMesh& cad = numbering.mesh;
  const ModelTables& t = cad.tables;
  const EdgeMesh& edges = numbering.update.edges;
  std::vector<std::int32_t> group(patches.size(), 0);
  std::vector<PatchUse> uses(patches.size());
  parallel_for(patches.size(), 1, [&](std::size_t i, std::size_t) {
    const auto f = static_cast<FaceId>(i);
    if (cad.face_size(f) > 0) group[i] = cad.mesh.triangle_group[cad.face_begin[f]];
    uses[i] = patches[i].face == kNone ? OldFace(numbering, f).use() : use_of(edges, t.n_vertices(), patches[i]);
  });
  PatchNumbers numbers(edges, t.vertex_xyz.size());
  for (const PatchUse& use : uses) numbers.add(use);
  numbers.number();
  const MergeInput input{edges, t.vertex_xyz, t.edge_vertices, {}, group};
  SurfaceMesh mesh = numbers.make_mesh(edges, t.vertex_xyz);
  describe_boundary(input, numbers, mesh);
  mesh.node_previous.resize(mesh.node_xyz.size(), kNone);
  mesh.triangle_previous.resize(mesh.triangles.size(), kNone);
  parallel_for(patches.size(), 1, [&](std::size_t i, std::size_t) {
    if (patches[i].face == kNone) return OldFace(numbering, static_cast<FaceId>(i)).copy_to(numbers, mesh);
    numbers.place_patch(edges, patches[i], i, mesh);
    describe_patch(input, numbers, patches[i], i, mesh);
  });
  mesh.labels = cad.mesh.labels;
  return mesh;
}

}  // namespace st
