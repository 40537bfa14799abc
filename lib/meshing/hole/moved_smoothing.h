// Nodes of a moved face, smoothed on its surface.
#pragma once

#include <span>

#include "geometry/shape/surface.h"
#include "mesh/surface_mesh.h"

namespace st {

/// Quality of triangle `t` of a moved mesh: that of its corners, negative where the move turned it over. `side`: -1
/// where (u,v) of its face were mirrored, else 1. `squeeze`: [n_nodes] of stretched sizes, see TriangleCorners; empty:
/// corners in space. [-1, 1].
double moved_quality(const SurfaceMesh& old, const SurfaceMesh& moved, TriangleId t, double side,
                     std::span<const Vec3> squeeze);

/// Spreads over the nodes inside the face of triangles [begin, end) by how much (u,v) on its boundary went elsewhere
/// than a map took them: changes what corner_uv of `moved` has there by values that differ as little as possible
/// between neighbours, against their distance in `old` (a discrete Laplace equation). `by`: [3 * (end - begin)] that of
/// corners on the boundary, others are ignored. Local, a sparse solution. The same at every run.
void spread_boundary_shift(const SurfaceMesh& old, TriangleId begin, TriangleId end, std::span<const Vec2> by,
                           SurfaceMesh& moved);

/// Moves nodes inside the face of triangles [begin, end) of `moved`, and their (u,v): around triangles that the move
/// made bad (quality below 0.6 and worse than in `old`), each so that the worst triangle at it becomes better (pattern
/// search from the middle of its neighbours, as Freitag and Ollivier-Gooch 1997 do in the plane). Nodes on edges stay,
/// and no connection changes. `squeeze` as above. Local; linear in the nodes around bad triangles. The same at every
/// run.
void smooth_moved_face(const Surface& surface, const SurfaceMesh& old, TriangleId begin, TriangleId end, double side,
                       std::span<const Vec3> squeeze, SurfaceMesh& moved);

}  // namespace st
