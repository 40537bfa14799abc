// Boxes along the axes: those in the parameter plane, and what is near those in space (base/vec.h).
#pragma once

#include <algorithm>

#include "base/vec.h"

namespace st {

/// Empty when lo > hi.
struct Box2 {
  Vec2 lo{1e300, 1e300}, hi{-1e300, -1e300};
  void add(Vec2 p) {
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
    hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
  }
  bool is_empty() const { return lo.x > hi.x; }
  Vec2 size() const { return hi - lo; }
  Vec2 center() const { return 0.5 * (lo + hi); }
};

/// Whether two boxes have a point in common, or are no farther apart than `tolerance` along each axis; empty ones meet
/// none.
inline bool meet(const Box3& a, const Box3& b, double tolerance = 0) {
  return a.lo.x <= b.hi.x + tolerance && b.lo.x <= a.hi.x + tolerance && a.lo.y <= b.hi.y + tolerance &&
         b.lo.y <= a.hi.y + tolerance && a.lo.z <= b.hi.z + tolerance && b.lo.z <= a.hi.z + tolerance;
}

/// What two boxes have in common; of two that do not meet, a box with lo > hi along some axis.
inline Box3 common_box(const Box3& a, const Box3& b) {
  return {{std::max(a.lo.x, b.lo.x), std::max(a.lo.y, b.lo.y), std::max(a.lo.z, b.lo.z)},
          {std::min(a.hi.x, b.hi.x), std::min(a.hi.y, b.hi.y), std::min(a.hi.z, b.hi.z)}};
}

/// Whether `inner` is nowhere farther outside than `tolerance` along each axis; boundaries may be common.
inline bool contains(const Box3& outer, const Box3& inner, double tolerance = 0) {
  return inner.lo.x >= outer.lo.x - tolerance && inner.lo.y >= outer.lo.y - tolerance &&
         inner.lo.z >= outer.lo.z - tolerance && inner.hi.x <= outer.hi.x + tolerance &&
         inner.hi.y <= outer.hi.y + tolerance && inner.hi.z <= outer.hi.z + tolerance;
}
inline bool contains(const Box3& box, Vec3 x, double tolerance = 0) { return contains(box, Box3{x, x}, tolerance); }

/// Squared distance from a point to a box; 0 inside.
inline double distance2(Vec3 x, const Box3& box) {
  const auto gap = [](double at, double lo, double hi) { return at < lo ? lo - at : at > hi ? at - hi : 0.0; };
  return norm2({gap(x.x, box.lo.x, box.hi.x), gap(x.y, box.lo.y, box.hi.y), gap(x.z, box.lo.z, box.hi.z)});
}

}  // namespace st
