// The rest of a closed surface: what is on the other side of the one loop of a face.
#pragma once

#include <TopoDS_Face.hxx>

namespace st::occt {

/// Whether a face may be on either side of its loop: it has one, without a seam, on a surface that closes all around
/// (sphere, torus, what turns about an axis from pole to pole). The loop meets no pole, or goes from one to the other
/// and back.
bool may_be_on_either_side(const TopoDS_Face& face);

/// The rest of its surface, facing the other way; null where it cannot be made. Edges get further curves, those of
/// `face` stay. Precondition: may_be_on_either_side().
TopoDS_Face other_side(const TopoDS_Face& face);

}  // namespace st::occt
