// A patch of a face in sections, each on the rank that made it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "mesh/node_key.h"
#include "mesh/patch_blocks.h"
#include "mesh/surface_mesh.h"

namespace st {

/// Where a section of the patch of a face is, how large, and where it has its rows in that; see PatchSection.
struct PatchPlace {
  FaceId face = kNone;
  std::int32_t rank = kNone;  ///< kNone: it has no triangles
  std::int32_t section = 0;   ///< of its face
  std::int64_t version = 0;   ///< a face may have several patches at a time, of different rounds
  std::int32_t n_boundary = 0, n_inner = 0, n_triangles = 0, n_own_uv = 0;  ///< n_inner: of its own
  std::int64_t inner_begin = 0, triangle_begin = 0, own_uv_begin = 0;       ///< its rows
  Box3 box;                                                                 ///< of the triangles

  bool is_there() const { return rank != kNone; }

  static auto fields(auto& p) {
    return std::tie(p.face, p.rank, p.section, p.version, p.n_boundary, p.n_inner, p.n_triangles, p.n_own_uv,
                    p.inner_begin, p.triangle_begin, p.own_uv_begin, p.box);
  }
};

/// Some triangles of a face, with the nodes of these. A whole patch is one section that shares no inner node.
struct PatchSection {
  FacePatch patch;                                 ///< its inner nodes: first its own, then those that others own
  bool is_whole_boundary = true;                   ///< it has all nodes on the boundary of the face; else:
  std::vector<std::int32_t> boundary_number = {};  ///< [n_boundary] in the patch of the face
  std::int32_t n_foreign = 0;                      ///< of the inner nodes
  std::vector<std::int32_t> shared = {};           ///< inner nodes that other sections have, too, ascending
  std::vector<NodeKey> shared_key = {};            ///< likewise
  PatchBlocks blocks = {};                         ///< of its triangles; only where it is kept, see PatchStore

  std::int32_t n_own() const { return static_cast<std::int32_t>(patch.inner_xyz.size()) - n_foreign; }

  static auto fields(auto& s) {
    return std::tie(s.patch, s.is_whole_boundary, s.boundary_number, s.n_foreign, s.shared, s.shared_key);
  }
};

/// What the nodes of a section are called in the mesh of all: it has nodes on the boundary, its own ones, which follow
/// each other there, and those that other sections own.
class SectionNumbers {
 public:
  /// `n_local` of the boundary, which are `boundary` there; empty: the same. `first_own` of `n_own` of its own; others.
  SectionNumbers(std::int32_t n_local, std::span<const std::int32_t> boundary, std::int32_t n_own, NodeId first_own,
                 std::vector<NodeId> foreign)
      : n_local_(n_local), boundary_(boundary), n_own_(n_own), first_own_(first_own), foreign_(std::move(foreign)) {}
  NodeId operator()(NodeId n) const {
    if (n < n_local_) return boundary_.empty() ? n : boundary_[n];
    n -= n_local_;
    return n < n_own_ ? first_own_ + n : foreign_[n - n_own_];
  }

 private:
  std::int32_t n_local_;
  std::span<const std::int32_t> boundary_;
  std::int32_t n_own_;
  NodeId first_own_;
  std::vector<NodeId> foreign_;
};

/// What section `own` is in the patch of its face, as rows of it: its boundary is all of that, or none. Nodes are those
/// of the whole patch. `places` [n_sections]. Linear.
FacePatch rows_of(PatchSection&& section, std::span<const PatchPlace> places, std::size_t own);

/// The patch from the rows of all its sections, in order.
FacePatch join_rows(std::vector<FacePatch>&& rows);

}  // namespace st
