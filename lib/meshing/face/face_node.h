// A node of a face: on its boundary or inside.
#pragma once

#include "base/ids.h"
#include "base/vec.h"

namespace st {

struct FaceNode {
  Vec2 uv;
  Vec3 x;                   ///< space, model unit
  double h = 0;             ///< requested length
  std::int32_t id = kNone;  ///< node outside the face, equal for seam twins and for the nodes of a pole; kNone: inside
  bool is_pole = false;     ///< on a degenerate edge
};

}  // namespace st
