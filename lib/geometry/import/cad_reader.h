// STEP, IGES, BREP and FLITE files to one shape with names, colours and layers.
#pragma once

#include <string>

#include "geometry/brep/cad_file.h"

namespace st::occt {

/// Coordinates in mm (STEP, IGES) or as they are (BREP, FLITE). Throws st::Error(kInput).
CadFile read_cad(const std::string& path);

}  // namespace st::occt
