// Seams to which the readers of STEP and IGES give no trimming curves, or curves beyond the poles.
#pragma once

#include <TopoDS_Face.hxx>
#include <span>

namespace st::occt {

/// OpenCASCADE leaves the trimming curves of seams to its healing, or gives each the other's. Where another edge of the
/// loop runs into a pole, as on a ball with a notch whose side passes the pole, or where a seam is in pieces that all
/// have none, the healing then closes the loop without the seam: the face is what was cut off. In such a loop the seam
/// gets its two curves along the bounds of u, by the direction in which the loop passes it. Only on surfaces that are
/// closed in u and have poles. Returns the number of edges that got them.
int give_seams_curves(std::span<const TopoDS_Face> faces);

/// IGES files may hold the curves in space alone, and have a seam twice: once for each direction. OpenCASCADE gives
/// both the same trimming curve, and the face of a body between two poles has no area. Of two edges of a loop without
/// trimming curves that are each other's way back, the first takes the place of the other, and gets the two curves of a
/// seam, on surfaces that are closed in u and have poles. On those that are closed both ways (tori) edges with trimming
/// curves a period apart become one, too: the healing takes a loop that runs into a notch on the one side of a seam,
/// and on the other side goes on behind it, for the notch. Returns the number of such edges.
int make_seams(std::span<const TopoDS_Face> faces);

/// The curve of a meridian may start anywhere on its circle: then the trimming curves of a piece of a sphere's seam are
/// a turn beyond the pole. The healing takes pieces that do not follow each other for spurs, as on a ball with a bore
/// along its axis, and removes what lies beyond. Such curves are moved by whole turns of v.
/// Returns the number of edges changed.
int move_curves_between_poles(std::span<const TopoDS_Face> faces);

}  // namespace st::occt
