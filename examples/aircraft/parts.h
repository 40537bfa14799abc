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

/// All parts of the aircraft; their faces get their group names in `names`.
std::vector<Part> make_parts(NameTable& names);

/// Half box around the aircraft, ten body lengths away; its face y = 0 is "symmetry", the others are "farfield".
TopoDS_Solid make_far_field(NameTable& names);

}  // namespace aircraft
