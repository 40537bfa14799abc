// Normals at the nodes of facets: those of the surface that they stand for.
#pragma once

#include <vector>

#include "geometry/facet/facet_mesh.h"

namespace st {

/// Sets `normal` and `corner_normal` of the mesh, whose lines are marked. `neighbours`, as find_neighbours() has them,
/// and `triangle_normal`: [n_triangles].
void set_corner_normals(FacetMesh& mesh, const std::vector<Corners>& neighbours,
                        const std::vector<Vec3>& triangle_normal);

}  // namespace st
