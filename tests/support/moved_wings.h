// Wings whose shape follows a number, of the same topology for all of them.
#pragma once

#include <TopoDS_Shape.hxx>

namespace st::test {

/// Chord 60 (x), span 100 (y), 12 % thick, sharp trailing edge; the tip turned by `twist_deg` about the quarter chord.
TopoDS_Shape twisted_wing(double twist_deg);

/// Chord 60, span 40, 13 % thick, blunt trailing edge; the last 30 % of the chord turned down by `flap_deg` about its
/// hinge, in one skin with the rest.
TopoDS_Shape flapped_wing(double flap_deg);

/// The same with a flap along the middle 16 of the span only: the walls beside it change their shape with the flap. Of
/// one topology for 4 to 40 degrees.
TopoDS_Shape part_flapped_wing(double flap_deg);

}  // namespace st::test
