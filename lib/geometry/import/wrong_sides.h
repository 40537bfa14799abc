// Faces that the reader of STEP takes for what is on the other side of their loop.
#pragma once

#include <vector>

#include "geometry/brep/cad_file.h"
#include "geometry/import/import.h"

namespace st::occt {

/// A ball with a stem is a sphere with one loop. Where the seam meets the loop, or is not in the file, OpenCASCADE
/// takes the small cap inside the loop, and turns it: the solid is the stem alone. Of the round corner of a bent pipe,
/// a loop from pole to pole and back, it may take the rest of the ball. A face that may be on either side of its loop
/// gets the rest of its surface where the file has a seam in its loop, where it is folded back onto a neighbour that is
/// tangent to it, or where it lies on another side of its edges than the file says and meets none smoothly, as a
/// fillet's corner would. Loops along a seam are mended by with_chains_turned(). Each is said in `findings`.
void mend_wrong_sides(CadFile& file, std::vector<ImportFinding>& findings);

}  // namespace st::occt
