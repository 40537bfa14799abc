// The advancing front inside a constrained triangulation of the face (Rebay 1993; Marcum and Weatherill 1995): internal
// to lib/meshing.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "geometry/shape/surface.h"
#include "meshing/face/triangulation.h"
#include "sizing/size_field.h"

namespace st {

/// The face being meshed: its triangulation, surface, sizes and the scaling of (u,v) to the plane.
struct FaceWork {
  Triangulation mesh;
  const Surface* surface = nullptr;
  const SizeField* field = nullptr;
  std::vector<std::pair<std::int32_t, std::int32_t>> segments;  ///< of the loops, plane nodes
  Vec2 scale{1, 1};                                             ///< plane = scale * (u,v)
  double max_turning = 1.0;   ///< radians between the normals of two nodes of a side, where L_min would allow more
  std::size_t max_nodes = 0;  ///< more is a runaway: the front stops
  int hint = 0;

  /// Sets the surface and the scale: mean lengths of the derivatives.
  void set_surface(const Surface& s);
  /// Of an evaluated node: the normal a little inside where the parametrisation is singular at the boundary.
  Vec3 reliable_normal(const MeshNode& n) const;
  /// Sets request, h and squeeze of a node from the field.
  void ask_sizes(MeshNode& n);
  /// Fills uv, x, du, dv and the normal of a node from its p.
  void evaluate(MeshNode& n) const;
  /// Square of the circumradius of triangle t in space; large where it does not resolve the surface (seam twins,
  /// sheets).
  double circumradius2(const PlaneTriangle& t) const;
  /// Length of an edge, and its square: in space, or along the surface where that is much longer.
  double edge_length(std::int32_t a, std::int32_t b) const { return std::sqrt(edge_length2(a, b)); }
  double edge_length2(std::int32_t a, std::int32_t b) const;
};

/// Lengths of steps in the plane at a node, or from one to another.
Metric metric_of(const MeshNode& n);
Metric metric_of(Vec3 du, Vec3 dv, const MeshNode& a, const MeshNode& b);

/// Advances the front from the boundary until every triangle is finished or retired, then splits what is still too
/// large.
void advance_front(FaceWork& work);

/// Swaps, smooths, collapses and splits for `rounds` rounds; keeps the triangulation valid in the plane and does not
/// fold it in space.
void enhance(FaceWork& work, int rounds);

}  // namespace st
