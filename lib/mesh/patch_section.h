// A patch of a face in sections, each on the rank that made it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "mesh/surface_mesh.h"

namespace st {

/// Where a section of the patch of a face is, how large, and where it has its rows in that.
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

/// What section `own` is in the patch of its face, as rows of it: its boundary is all of that, or none. Nodes are those
/// of the whole patch. `places` [n_sections]. Linear.
FacePatch rows_of(FacePatch&& section, std::span<const PatchPlace> places, std::size_t own);

/// The patch from the rows of all its sections, in order.
FacePatch join_rows(std::vector<FacePatch>&& rows);

}  // namespace st
