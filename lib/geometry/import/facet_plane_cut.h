// Facets cut at a plane across an axis.
#pragma once

#include "base/axis.h"
#include "geometry/facet/facet_mesh.h"
#include "geometry/import/half_model.h"

namespace st {

/// Towards the kept side, model unit.
inline double height_above(const occt::SymmetryPlane& plane, const Vec3& x) {
  return plane.side * (component(x, plane.axis) - plane.value);
}

/// Keeps what is on the kept side; facets in the plane go. Nodes there are in the plane to the last bit: those of
/// free sides within 1e-5 of the diagonal, others within single precision. The end of a side that meets the plane
/// within 2 % of it goes there, where facets allow, so that no slivers remain. Precondition: the side of `plane` is
/// chosen.
void cut_at_plane(FacetMesh& mesh, const occt::SymmetryPlane& plane);

}  // namespace st
