// (u,v) of the corners of a patch's triangles: most are those of nodes inside the face, and stored there.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mesh/surface_mesh.h"

namespace st {

/// Corner k of triangle t is corner 3*t + k. The patch is valid: has_all_uv().
Vec2 corner_uv(const FacePatch& patch, std::size_t corner);

/// The (u,v) of the corners of triangles [begin, end).
std::vector<Vec2> corner_uvs(const FacePatch& patch, std::size_t begin, std::size_t end);
/// The (u,v) of all corners, [3*n_triangles].
inline std::vector<Vec2> corner_uvs(const FacePatch& patch) { return corner_uvs(patch, 0, patch.triangles.size()); }

/// The inverse: uv_corner and own_uv, from `all` [3*n_triangles] and from the nodes inside.
void set_corner_uvs(std::span<const Vec2> all, FacePatch& patch);

/// Whether each corner has a (u,v): those on the boundary their own, in order. The triangles' nodes are the patch's.
bool has_all_uv(const FacePatch& patch);

}  // namespace st
