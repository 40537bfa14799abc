// FLITE geometry files to shapes.
#pragma once

#include <string>

#include "geometry/brep/cad_file.h"

namespace st::occt {

/// One part, a face per region in the order of the file, named "region 7". Segments that regions share are shared
/// edges; faces that share edges form shells, all turned the same way. Throws Error(kInput): see read_flite(),
/// flite_topology(); and where a segment is not on the surface of its region.
CadFile read_flite_shape(const std::string& path);

}  // namespace st::occt
