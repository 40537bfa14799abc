/// The models of the pages in examples/jobs. Lengths as each says; faces get their group names in `names`.
#pragma once

#include <TopoDS_Shape.hxx>

#include "../aircraft/patchwork.h"

namespace aircraft {

/// A propeller of four blades and 0.4 m diameter on its hub, axis x: one solid. Metres.
TopoDS_Shape make_propeller(NameTable& names);

/// The starboard half of a hull of 120 m with a bulb, y >= 0, water line at z = 0: its skin and its transom alone, open
/// at the plane of symmetry and at the deck, as naval architects hand it over. Metres.
TopoDS_Shape make_hull(NameTable& names);

/// The air between two vanes of a linear cascade, span along y: one solid around a vane of 80 mm chord. Metres.
TopoDS_Shape make_cascade(NameTable& names);

/// A bearing bracket with bolt holes, ribs and fillets: one solid. Millimetres.
TopoDS_Shape make_bracket(NameTable& names);

/// A T of pipes with flanges: one solid. Millimetres.
TopoDS_Shape make_tee(NameTable& names);

}  // namespace aircraft
