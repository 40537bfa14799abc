// Seams whose two trimming curves the reader of STEP has put the wrong way round.
#pragma once

#include <TopoDS_Face.hxx>
#include <span>

namespace st::occt {

/// A loop that meets a seam twice, as that of a body with a fin on its seam, goes along two pieces of it, each there
/// and back. OpenCASCADE may give one of them its two curves in the wrong order: then no end of it is where another
/// edge of the loop ends in (u,v), and would be with the other order. Its healing takes such a piece for a spur and
/// removes it, with all of the face that lies beyond. Such curves change places, in the shape itself. Returns the
/// number of edges changed.
int swap_seams(std::span<const TopoDS_Face> faces);

}  // namespace st::occt
