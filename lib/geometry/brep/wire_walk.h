// The edges of a wire from head to tail.
#pragma once

#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>
#include <vector>

#include "geometry/brep/uv_box.h"

namespace st::occt {

/// The edges of a wire of the face that bound something (no constraints), oriented as the wire runs, each from where
/// the one before ended. `face`: oriented FORWARD. OpenCASCADE's order; where that loses edges, as at a vertex that the
/// loop passes twice, the order of the file if it is one ring, in space and in (u,v). Fewer than the wire has where
/// neither is. `bounds`: uv_box(face), which a face of many loops has once for all.
std::vector<TopoDS_Edge> walk_wire(const TopoDS_Wire& wire, const TopoDS_Face& face, const Box2& bounds);

/// Whether walk_wire() reaches all edges that bound something.
bool can_be_walked(const TopoDS_Wire& wire, const TopoDS_Face& face, const Box2& bounds);
inline bool can_be_walked(const TopoDS_Wire& wire, const TopoDS_Face& face) {
  return can_be_walked(wire, face, uv_box(face));
}

}  // namespace st::occt
