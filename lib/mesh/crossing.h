// Triangles that cross each other, found exactly.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "mesh/surface_mesh.h"

namespace st {

/// Two triangles with more in common than the nodes they share.
struct TrianglePair {
  TriangleId a = kNone, b = kNone;  ///< a < b
  std::int32_t n_shared = 0;        ///< number of nodes they share by id: 0, 1 or 2
};

/// All pairs of triangles that cross, touch or overlap, sorted by (a, b): without a common node, any common point
/// counts; with one, any further common point; with two, an overlap of positive area. Pairs with three common nodes
/// (duplicates) are not listed, nor are triangles of no area (a repeated node, or three collinear ones). Exact,
/// whatever the rounding; the order of the input does not matter for what is found. `points` finite. About n log n; a
/// million triangles of a clean mesh take a second or two.
std::vector<TrianglePair> find_crossing_triangles(std::span<const Vec3> points, std::span<const Triangle> triangles);
/// The same, but where triangles lie in each other without end the search is ended (most_comparisons()). `was_ended` is
/// set then, and these are not all pairs. `n_compared` gets how many comparisons it took, unless null.
std::vector<TrianglePair> find_crossing_triangles(std::span<const Vec3> points, std::span<const Triangle> triangles,
                                                  bool& was_ended, std::int64_t* n_compared = nullptr);

/// The exact test of one pair; `n_shared` as above. Precondition: neither triangle is degenerate.
bool triangles_cross(std::span<const Vec3> points, const Triangle& a, const Triangle& b, int& n_shared);

/// True when the triangle has no area: a repeated node, or three exactly collinear points.
bool is_degenerate(std::span<const Vec3> points, const Triangle& t);

}  // namespace st
