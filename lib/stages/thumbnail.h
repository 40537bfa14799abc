// A small picture of a mesh.
#pragma once

#include <string>

#include "mesh/surface_mesh.h"

namespace st {

/// A grey bitmap (BMP, 8 bits) of 160 by 120 points as a data URI, seen from ahead, above and beside, of a half model
/// from its outside; without far field and symmetry planes. Empty for a mesh without triangles. Linear in triangles.
std::string thumbnail(const SurfaceMesh& mesh);

}  // namespace st
