// What a size field asks for on a mesh.
#pragma once

#include <vector>

#include "mesh/conformity.h"
#include "sizing/size_field.h"

namespace st {

/// For measure_conformity(). Null where lengths do not depend on planes. The field outlives it.
RequestedLength lengths_along(const SizeField& field);

/// [n_nodes] in the planes of the nodes' mean normals; empty where sizes are the same length in all directions, or
/// unknown (null).
std::vector<Vec3> squeeze_of_nodes(const SurfaceMesh& mesh, const SizeField* field);

}  // namespace st
