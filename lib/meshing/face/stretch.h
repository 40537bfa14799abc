// Lengths as stretched sizes see them: shorter along the direction in which edges may be longer.
#pragma once

#include <cmath>

#include "base/local_size.h"
#include "meshing/face/triangulation.h"
#include "sizing/size_field.h"

namespace st {

/// The `squeeze` of a node whose sizes are these, in its tangent plane; see base/local_size.h.
Vec3 squeeze_of(const LocalSize& local, Vec3 normal);

/// Product of two vectors, and square, in the mean metric of the nodes.
inline double product(Vec3 d, Vec3 e, const MeshNode& a) { return dot(d, e) - dot(a.squeeze, d) * dot(a.squeeze, e); }
inline double product(Vec3 d, Vec3 e, const MeshNode& a, const MeshNode& b) {
  return dot(d, e) - 0.5 * (dot(a.squeeze, d) * dot(a.squeeze, e) + dot(b.squeeze, d) * dot(b.squeeze, e));
}
inline double length2(Vec3 d, const MeshNode& a) { return product(d, d, a); }
inline double length2(Vec3 d, const MeshNode& a, const MeshNode& b) { return product(d, d, a, b); }
inline double length2(Vec3 d, const MeshNode& a, const MeshNode& b, const MeshNode& c) {
  const double sa = dot(a.squeeze, d), sb = dot(b.squeeze, d), sc = dot(c.squeeze, d);
  return norm2(d) - (sa * sa + sb * sb + sc * sc) / 3;
}
/// The same where it is known at compile time whether any sizes are stretched.
template <bool kStretched, typename... Nodes>
double mean_length2(Vec3 d, const Nodes&... nodes) {
  if constexpr (kStretched) return length2(d, nodes...);
  return norm2(d);
}
template <bool kStretched, typename... Nodes>
double mean_product(Vec3 d, Vec3 e, const Nodes&... nodes) {
  if constexpr (kStretched) return product(d, e, nodes...);
  return dot(d, e);
}
inline double side_length(const MeshNode& a, const MeshNode& b) { return std::sqrt(length2(b.x - a.x, a, b)); }

/// Square of the area of a triangle in the mean metric over that in space.
inline double area_share2(const MeshNode& a, const MeshNode& b, const MeshNode& c) {
  const Vec3 &p = a.squeeze, &q = b.squeeze, &r = c.squeeze;
  const double trace = (norm2(p) + norm2(q) + norm2(r)) / 3;
  return 1 - trace + (norm2(cross(p, q)) + norm2(cross(q, r)) + norm2(cross(r, p))) / 9;
}

inline bool is_stretched(const MeshNode& n) { return n.squeeze != Vec3{}; }
/// Length along over length across, >= 1.
inline double aspect_of(const MeshNode& n) { return 1 / std::sqrt(1 - norm2(n.squeeze)); }

}  // namespace st
