#include "sizing/space_sides.h"

#include <algorithm>

namespace st {

Vec3 SpaceSide::nearest_to(Vec3 x) const { return a + std::clamp(dot(x - a, along), 0.0, length) * along; }

std::vector<SpaceSide> sides_in_space(const Surface& surface, const LoopPolygons& loops) {
  std::vector<SpaceSide> sides;
  Vec2 last{};
  Vec3 end;  // of the side before, at `last`
  for (const LoopSide& s : loops.sides()) {
    if (s.coedge == kNone) continue;
    const bool goes_on = !sides.empty() && s.a.x == last.x && s.a.y == last.y;
    const Vec3 a = goes_on ? end : surface.point(s.a);
    last = s.b, end = surface.point(s.b);
    const SurfacePoint middle = surface.evaluate(0.5 * (s.a + s.b));
    const Vec3 along = normalized(end - a), inward = normalized(cross(cross(middle.du, middle.dv), along));
    if (norm2(along) > 0 && norm2(inward) > 0) sides.push_back({a, along, inward, distance(a, end), s.coedge});
  }
  return sides;
}

BoxTree tree_of(std::span<const SpaceSide> sides) {
  std::vector<Box3> boxes(sides.size());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    boxes[i].add(sides[i].a);
    boxes[i].add(sides[i].end());
  }
  return BoxTree(boxes);
}

}  // namespace st
