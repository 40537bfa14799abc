// Which cells of an octree a triangulated surface cuts, and what of it lies in them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/surface_mesh.h"
#include "sizing/octree.h"

namespace st {

/// Points and triangles of a surface.
struct SurfaceView {
  std::span<const Vec3> points;
  std::span<const Triangle> triangles;

  Vec3 corner(TriangleId t, int k) const { return points[triangles[t].n[k]]; }
};

/// CSR: the triangles in each leaf that has any.
struct CutCells {
  std::vector<std::int32_t> leaf;        ///< [n_cut] ascending
  std::vector<std::int64_t> offsets{0};  ///< [n_cut+1]
  std::vector<TriangleId> triangle;      ///< [offsets.back()] ascending in each leaf

  std::int32_t n_cut() const { return static_cast<std::int32_t>(leaf.size()); }
  std::span<const TriangleId> triangles(std::int32_t cut) const {
    return std::span<const TriangleId>(triangle).subspan(offsets[cut], offsets[cut + 1] - offsets[cut]);
  }
};

/// Leaves that triangles meet; touching counts. Triangles outside the root are ignored.
CutCells find_cut_cells(const OctreeView& octree, const SurfaceView& surface);

/// Part of a triangle in a cube; empty: none.
struct ClippedTriangle {
  int n = 0;
  Vec3 corner[9];

  Vec3 middle() const;
};
ClippedTriangle clip_triangle(Vec3 a, Vec3 b, Vec3 c, Vec3 center, double half);

/// Whether the closed segment pq and the closed triangle have a point in common. Exact.
bool segment_meets_triangle(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c);
/// Likewise, where p and q are known not to lie on one side of it.
bool line_meets_triangle(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c);

/// How often a closed, oriented surface winds around `x`: 1 inside, 0 outside. Exact, unless x lies on it.
/// O(n_triangles).
int winding_number(const SurfaceView& surface, Vec3 x);
/// Likewise of many points, on all threads. Each triangle looks at those alone that have its y.
std::vector<int> winding_numbers(const SurfaceView& surface, std::span<const Vec3> points);

}  // namespace st
