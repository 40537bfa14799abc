// Lengths as stretched sizes see them: shorter along the direction in which edges may be longer.
#pragma once

#include <cmath>

#include "meshing/face/triangulation.h"

namespace st {

/// `squeeze` of a node whose sizes are these: with direction t in the tangent plane, t sqrt(1 - (length/along)^2). Zero:
/// the same length in all directions. |d|^2 - (squeeze . d)^2 is the squared length of d over that of an edge across.
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

/// Into the space in which the node's metric is Euclidean, and back.
inline Vec3 squeezed(Vec3 d, const MeshNode& n) {
  const double w = std::sqrt(1 - norm2(n.squeeze));
  return d - (dot(n.squeeze, d) / (1 + w)) * n.squeeze;
}
inline Vec3 unsqueezed(Vec3 d, const MeshNode& n) {
  const double w = std::sqrt(1 - norm2(n.squeeze));
  return d + (dot(n.squeeze, d) / (w * (1 + w))) * n.squeeze;
}

}  // namespace st
