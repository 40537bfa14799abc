// The surface at the corners of triangles, and above the middles of their sides, each evaluated about once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "geometry/shape/surface.h"

namespace st {

/// Neighbouring triangles of a face have corners and sides in common; what was found for one is kept for the next. A
/// place is forgotten when another one needs its slot, so the memory is bounded, and results never depend on it. One
/// per thread.
class CornerPoints {
 public:
  CornerPoints() : corners_(kSlots), sides_(kSideSlots) {}

  /// `surface` is that of `face`, the node lies at (u,v) there.
  const SurfacePoint& corner(const Surface& surface, FaceId face, NodeId node, Vec2 uv) {
    Corner& c = corners_[static_cast<std::size_t>(node) % kSlots];
    if (c.face != face || c.node != node || !(c.uv == uv)) c = {face, node, uv, surface.evaluate(uv)};
    return c.point;
  }

  /// What `make()` gives for the side between two nodes; it must be the same from both of its ends.
  template <typename Make>
  Vec3 side(FaceId face, NodeId a, NodeId b, Vec2 uv_a, Vec2 uv_b, const Make& make) {
    if (b < a) std::swap(a, b), std::swap(uv_a, uv_b);
    const auto hash = static_cast<std::size_t>(a) * 3 + static_cast<std::size_t>(b) * 1021;
    Side& s = sides_[hash % kSideSlots];
    if (s.face != face || s.a != a || s.b != b || !(s.uv_a == uv_a) || !(s.uv_b == uv_b))
      s = {face, a, b, uv_a, uv_b, make()};
    return s.foot;
  }

 private:
  // 1.6 MB: the rows at hand of a face of a million triangles, which have three sides for each node
  static constexpr std::size_t kSlots = 4096, kSideSlots = 4 * kSlots;

  struct Corner {
    FaceId face = kNone;
    NodeId node = kNone;
    Vec2 uv;
    SurfacePoint point;
  };
  struct Side {
    FaceId face = kNone;
    NodeId a = kNone, b = kNone;
    Vec2 uv_a, uv_b;
    Vec3 foot;
  };
  std::vector<Corner> corners_;
  std::vector<Side> sides_;
};

}  // namespace st
