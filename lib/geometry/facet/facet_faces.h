// Splits facets into smooth regions along lines where they turn sharply.
#pragma once

#include "geometry/facet/facet_mesh.h"

namespace st {

/// Regions as faces, numbered by their lowest triangle. Lines are where sides are not used exactly twice, where parts
/// meet, and where neighbours' normals differ by more than `feature` (radians); a line that ends inside a region stays
/// where it is longer than 2 % of the diagonal. A needle (height below 1e-3 of its longest side) has the normal of what
/// lies behind that side, but at a trailing edge, where it stays with its side of the wing. Normals at nodes are means
/// of their smooth fan's, by angle.
FacetMesh find_smooth_faces(const FacetInput& input, double feature);

}  // namespace st
