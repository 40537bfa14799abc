// Loops that pass a seam and that the reader of STEP turned.
#pragma once

#include <TopoDS_Face.hxx>

namespace st::occt {

/// A loop that meets the seam goes along the seam and back, and between by chains of other edges. Where OpenCASCADE
/// takes such a loop for turned, it turns it, and puts each chain one period beyond the seam: the face is on the wrong
/// side of the chains. The face with these turned back and inside the period, facing the other way; null where no chain
/// is outside, or the loop would not be closed. Edges get further curves, those of `face` stay.
TopoDS_Face with_chains_turned(const TopoDS_Face& face);

}  // namespace st::occt
