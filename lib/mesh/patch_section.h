// A patch of a face in sections, each on the rank that made it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "mesh/node_key.h"
#include "mesh/surface_mesh.h"

namespace st {

/// Where a section has its rows in the patch of its face.
struct SectionBegin {
  std::int64_t inner = 0, triangle = 0, own_uv = 0;
};

/// Some triangles of a face, with the nodes of these. A whole patch is one section that shares no inner node.
struct PatchSection {
  FacePatch patch;                                 ///< its inner nodes: first its own, then those that others own
  bool is_whole_boundary = true;                   ///< it has all nodes on the boundary of the face; else:
  std::vector<std::int32_t> boundary_number = {};  ///< [n_boundary] in the patch of the face
  std::int32_t n_foreign = 0;                      ///< of the inner nodes
  std::vector<std::int32_t> shared = {};           ///< inner nodes that other sections have, too, ascending
  std::vector<NodeKey> shared_key = {};            ///< likewise

  std::int32_t n_own() const { return static_cast<std::int32_t>(patch.inner_xyz.size()) - n_foreign; }

  static auto fields(auto& s) {
    return std::tie(s.patch, s.is_whole_boundary, s.boundary_number, s.n_foreign, s.shared, s.shared_key);
  }
};

/// Rows of the patch of a face.
struct SectionRows {
  FacePatch rows;            ///< their nodes are those of the whole patch
  SectionBegin begin;        ///< where they begin
  bool has_boundary = true;  ///< all of the boundary; else nothing of it

  static auto fields(auto& r) { return std::tie(r.rows, r.begin, r.has_boundary); }
};

/// What section `own` is in the patch of its face. `begins` [n_sections]; `n_boundary`: of that patch. Linear.
SectionRows rows_of(PatchSection&& section, std::span<const SectionBegin> begins, std::size_t own,
                    std::int32_t n_boundary);

/// The patch from the rows of all its sections, in order.
FacePatch join_rows(std::vector<SectionRows>&& rows);

}  // namespace st
