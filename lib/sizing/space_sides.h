// The sides of a face's loops in space.
#pragma once

#include <span>
#include <vector>

#include "base/box_tree.h"
#include "geometry/shape/loop_polygons.h"
#include "geometry/shape/surface.h"

namespace st {

/// A side of a loop polygon, on the surface.
struct SpaceSide {
  Vec3 a, along, inward;  ///< model unit; along, inward: unit
  double length = 0;      ///< above 0, model unit
  CoedgeId coedge = kNone;
  Vec3 end() const { return a + length * along; }
  Vec3 nearest_to(Vec3 x) const;
};

/// In the order of the loops. Sides without a coedge or without a length, such as those at poles, are left out. Local.
std::vector<SpaceSide> sides_in_space(const Surface& surface, const LoopPolygons& loops);

/// Of their boxes; its items are their places in `sides`.
BoxTree tree_of(std::span<const SpaceSide> sides);

}  // namespace st
