// Surfaces of revolution whose meridian goes on beyond the axis.
#pragma once

#include <TopoDS_Face.hxx>
#include <span>

namespace st::occt {

/// The meridian of a lemon is part of a circle that crosses the axis, and STEP files have the whole circle. Then the
/// tips are no bounds of the surface, and OpenCASCADE's healing makes no poles there: faces lose what is beyond a hole.
/// Such meridians end at the tips between which all faces on the surface lie, in the shape itself. Curves of edges on
/// the surface stay as they are. Returns the number of surfaces changed.
int trim_meridians(std::span<const TopoDS_Face> faces);

}  // namespace st::occt
