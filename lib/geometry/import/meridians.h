// Surfaces of revolution whose meridian goes on beyond the axis.
#pragma once

#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <span>

namespace st::occt {

/// The meridian of a lemon is part of a circle that crosses the axis, and STEP files have the whole circle. Then the
/// tips are no bounds of the surface, and OpenCASCADE's healing makes no poles there: faces lose what is beyond a hole.
/// Such meridians end at the tips between which all faces on the surface lie, in the shape itself. Curves of edges on
/// the surface stay as they are. Returns the number of surfaces changed.
int trim_meridians(std::span<const TopoDS_Face> faces);

/// A lemon or an apple alone has no edge in a STEP file, and its surface is both. Of a shell of one face without a
/// border, the meridian becomes the part between two tips around which the face looks outward, in the shape itself, and
/// its loops go. It stays where that is more than one part, or none. Returns the number of surfaces changed.
int trim_bare_meridians(const TopoDS_Shape& shape);

}  // namespace st::occt
