/// The parts of the transport aircraft as closed solids: half configuration, y >= 0, x aft, z up, nose at the origin;
/// lengths in metres. Parts overlap with clear angles where they meet, so that one boolean operation joins them.
#pragma once

#include <string>
#include <vector>

#include "patchwork.h"

namespace aircraft {

struct Part {
  std::string name;
  TopoDS_Solid solid;
};

enum class Tail { kConventional, kT, kCross, kV, kNone };

/// What a variant of the aircraft may have in its own way. The defaults are the bundled example.
struct Shape {
  double aft_per_span = 0.52;  ///< of the wing's leading edge: 27.5 degrees of sweep
  double dihedral_deg = 5.5;   ///< of the wing
  int n_engines = 1;           ///< under each wing, 0 to 2
  Tail tail = Tail::kConventional;
  double flaps_deg = 0;  ///< deflection of a slotted flap behind the outer wing; 0: none
};

/// All parts of the aircraft; their faces get their group names in `names`.
std::vector<Part> make_parts(const Shape& shape, NameTable& names);

/// Half box around the aircraft, ten body lengths away; its face y = 0 is "symmetry", the others are "farfield".
TopoDS_Solid make_far_field(NameTable& names);

}  // namespace aircraft
