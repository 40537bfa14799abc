// Triangles that a mesh lacks.
#pragma once

#include <vector>

#include "meshing/hole/hole_mesh.h"

namespace st {

/// A side with a triangle on one side only (or three), where no rim of the CAD is.
struct OpenSide {
  NodeId low, high;
  FaceId face;  ///< of its triangle
};

/// All open sides of the whole mesh, by nodes; none: every hole in the mesh is one of the CAD model. Local, linear, and
/// cheap when there are none.
std::vector<OpenSide> find_open_sides(const HoleMesh& mesh);

}  // namespace st
