// Cuts smooth regions of facets into patches that can be laid into a plane.
#pragma once

#include "geometry/facet/facet_mesh.h"

namespace st {

/// Cuts tubes, closed and deep regions by planes, until flatten() gives each piece parameters: these are `uv`, and the
/// pieces the faces from then on, region by region. Of 30 planes across the axes of space and of the piece the one is
/// taken whose cut is short and leaves no slivers; a tube is cut along. Throws Error(kGeometry) with the place of a
/// piece that cannot be cut.
void cut_into_charts(FacetMesh& mesh);

}  // namespace st
