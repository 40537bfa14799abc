// Faces of STEP files that have a point for their outer loop.
#pragma once

#include <TopoDS_Face.hxx>
#include <span>

namespace st::occt {

/// A body of revolution between two tips has no border. In a STEP file its face may have a VERTEX_LOOP in place of one,
/// beside the loops around its holes. OpenCASCADE makes a seam for a sphere and a torus. On other surfaces it takes the
/// inside of each hole for the face, and the body is gone. Such faces get the bounds of their surface, in the shape
/// itself, with a seam beside the holes. Only surfaces that are closed around, and from pole to pole or closed the
/// other way, too. Returns the number of faces changed.
int bound_whole_surfaces(std::span<const TopoDS_Face> faces);

/// The same for one face on any such surface whose loops are all holes; false where there is no place for a seam.
bool bound_around_holes(const TopoDS_Face& face);

}  // namespace st::occt
