// Boxes along the axes, in the parameter plane. Those in space: base/vec.h.
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

}  // namespace st
