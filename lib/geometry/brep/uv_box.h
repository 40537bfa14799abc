// Where a face lies in the parameter plane.
#pragma once

#include <BRepTools.hxx>
#include <TopoDS_Face.hxx>

#include "base/boxes.h"

namespace st::occt {

/// Box of the face's loops in (u,v).
inline Box2 uv_box(const TopoDS_Face& face) {
  Box2 box;
  BRepTools::UVBounds(face, box.lo.x, box.hi.x, box.lo.y, box.hi.y);
  return box;
}

}  // namespace st::occt
