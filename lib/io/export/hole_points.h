// Points in what a volume mesher must not fill.
#pragma once

#include <vector>

#include "mesh/surface_mesh.h"

namespace st {

struct HolePoints {
  std::vector<Vec3> points;  ///< one strictly inside each body, model unit
  int n_not_found = 0;       ///< bodies in which no point was found
};

/// Bodies that are no flow: closed components that are cavities (inside out, seen alone), and, where a group has the
/// role far field, closed components inside the one with the far field. The point is tried below the largest triangles
/// and confirmed by an exact winding number. Local; linear but for a few scans of the mesh for each body.
HolePoints find_hole_points(const SurfaceMesh& mesh);

}  // namespace st
