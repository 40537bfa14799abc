// Where the surface of a face closes on itself.
#pragma once

#include <TopoDS_Face.hxx>

#include "base/vec.h"

namespace st::occt {

/// How a surface closes; a period of 0: not at all.
struct SurfaceClosing {
  Vec2 lo, hi;  ///< its bounds
  Vec2 period;
  bool is_u_periodic = false, is_v_periodic = false;  ///< else it has no points beyond its bounds
};

/// Ends of a bounded surface that are one line within the tolerance of the face's edges, far below its size, count as
/// closed.
SurfaceClosing surface_closing(const TopoDS_Face& face);

}  // namespace st::occt
