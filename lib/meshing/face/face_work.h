// The face being meshed, between the front and the enhancer: internal to lib/meshing.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "geometry/shape/surface.h"
#include "meshing/face/plane_map.h"
#include "meshing/face/stretch.h"
#include "meshing/face/triangulation.h"
#include "sizing/size_field.h"

namespace st {

/// The face being meshed: its triangulation, surface, sizes and the scaling of (u,v) to the plane.
struct FaceWork {
  Triangulation mesh;
  const Surface* surface = nullptr;
  const SizeField* field = nullptr;
  std::vector<std::pair<std::int32_t, std::int32_t>> segments;  ///< of the loops, plane nodes
  PlaneMap plane;                                               ///< of (u,v)
  std::vector<std::pair<std::int32_t, Vec3>> shortened;  ///< nodes whose rows have less stretch: what is asked for
  double max_turning = 1.0;   ///< radians between the normals of two nodes of a side, where L_min would allow more
  std::size_t max_nodes = 0;  ///< as many are a runaway: the front stops
  std::function<std::size_t()> find_max_nodes;  ///< asked once, where max_nodes are there: how many are one in the end
  int hint = 0;

  /// Whether there are too many nodes.
  bool is_runaway();
  /// Sets the surface and the plane.
  void set_surface(const Surface& s);
  /// The plane node of a node of the face, with that one's place and request.
  MeshNode plane_node(const FaceNode& node) const;
  /// Of an evaluated node: the normal a little inside where the parametrisation is singular at the boundary.
  Vec3 reliable_normal(const MeshNode& n) const;
  /// Sets request, h and squeeze of a node from the field. Returns what that told.
  LocalSize ask_sizes(MeshNode& n);
  /// Fills uv, x, du, dv and the normal of a node from its p.
  void evaluate(MeshNode& n) const;
  /// Square of the length of an edge: in space, or along the surface where that is much longer. As all that is measured
  /// for each triangle it is compiled twice: where no sizes are stretched, the terms for that cost nothing.
  template <bool kStretched>
  double edge_length2(std::int32_t a, std::int32_t b) const;
  /// Along the surface from a to b, by chords: the derivatives at the ends do not tell it, as at a boundary the
  /// parametrisation may be ten times as fast as a little inside.
  template <bool kStretched>
  double way_along(const MeshNode& a, const MeshNode& b) const;
  /// Square of the circumradius of triangle t in space, from the squares of its edges v0-v1, v1-v2, v2-v0; large where
  /// it does not resolve the surface (seam twins, sheets).
  template <bool kStretched>
  double circumradius2(const PlaneTriangle& t, double a2, double b2, double c2) const;
  template <bool kStretched>
  double circumradius2(const PlaneTriangle& t) const {
    return circumradius2<kStretched>(t, edge_length2<kStretched>(t.v[0], t.v[1]),
                                     edge_length2<kStretched>(t.v[1], t.v[2]),
                                     edge_length2<kStretched>(t.v[2], t.v[0]));
  }
};

template <bool kStretched>
double FaceWork::edge_length2(std::int32_t ia, std::int32_t ib) const {
  const MeshNode &a = mesh.nodes[ia], &b = mesh.nodes[ib];
  const double chord2 = mean_length2<kStretched>(b.x - a.x, a, b);
  const Vec2 e = 0.5 * (b.p - a.p);
  const double along2 = mean_length2<kStretched>(e.x * (a.du + b.du) + e.y * (a.dv + b.dv), a, b);
  if (!(along2 > 4 * chord2) || are_one_pole(a, b)) return chord2;
  const double way = way_along<kStretched>(a, b);
  return way * way > 4 * chord2 ? way * way : chord2;
}

template <bool kStretched>
double FaceWork::way_along(const MeshNode& a, const MeshNode& b) const {
  constexpr int kChords = 4;
  double way = 0;
  Vec3 last = a.x;
  for (int i = 1; i <= kChords; ++i) {
    MeshNode next = b;
    if (i < kChords) {
      next.p = a.p + static_cast<double>(i) / kChords * (b.p - a.p);
      evaluate(next);
    }
    way += std::sqrt(mean_length2<kStretched>(next.x - last, a, b));
    last = next.x;
  }
  return way;
}

template <bool kStretched>
double FaceWork::circumradius2(const PlaneTriangle& t, double a2, double b2, double c2) const {
  const double longest2 = std::max({a2, b2, c2});
  const MeshNode &a = mesh.nodes[t.v[0]], &b = mesh.nodes[t.v[1]], &c = mesh.nodes[t.v[2]];
  double area4_2 = 4 * norm2(cross(b.x - a.x, c.x - a.x));  // (4 A)^2
  if constexpr (kStretched) area4_2 *= area_share2(a, b, c);
  if (area4_2 <= 1e-24 * longest2 * longest2)
    return longest2;  // a sliver, or no triangle in space (at a pole): as large as its longest side
  return std::clamp(a2 * b2 * c2 / area4_2, longest2 / 4, 100 * longest2);
}

/// Lengths of steps in the plane, from the derivatives at a node, or on the mean of two.
template <bool kStretched = true, typename... Nodes>
Metric metric_of(Vec3 du, Vec3 dv, const Nodes&... nodes) {
  const double e = mean_length2<kStretched>(du, nodes...), g = mean_length2<kStretched>(dv, nodes...);
  const double floor = 1e-9 * (e + g);  // a pole has a direction without length
  return {e + floor, mean_product<kStretched>(du, dv, nodes...), g + floor};
}
template <bool kStretched = true>
Metric metric_of(const MeshNode& n) {
  return metric_of<kStretched>(n.du, n.dv, n);
}

}  // namespace st
