// Edges of IGES files that come back to where they begin.
#pragma once

#include <TopoDS_Face.hxx>
#include <span>

namespace st::occt {

/// The reader of IGES gives a curve that comes back to its start one vertex where both ends are equal to 1e-7 mm, else
/// two, as in a file in metres. It and the healing then may run through such an edge either way: one side of a ring is
/// turned around, and the face goes on beyond its surface. An edge whose ends are nearer than `precision` (mm) or a
/// 1e-7th of the way to its middle, which is at least 100 times the precision, gets one vertex. Where it meets the
/// edges before and after it in (u,v) only the other way round, it is turned. Faces are changed themselves. Returns the
/// number of edges that got one vertex.
int join_ring_ends(std::span<const TopoDS_Face> faces, double precision);

}  // namespace st::occt
