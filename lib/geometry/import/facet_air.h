// The fluid around facets: symmetry plane and far field.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/facet/facet_mesh.h"
#include "geometry/import/half_model.h"
#include "geometry/model/finding.h"

namespace st {

/// As occt::make_flow_domain, for facets: cuts them at the plane where they lie on both sides, closes them there by
/// plane facets of the part "symmetry"; with a far field the result is the fluid between the body and facets of the
/// part "farfield", which end the list. `mesh` has smooth regions as faces; new ones come last. A node within 2 % of a
/// side from the plane goes to where that side meets it. Throws Error(kGeometry) with places for free sides that are
/// not in the plane, for a model that does not reach it, and where outlines in the plane cross.
void make_flow_domain(FacetMesh& mesh, std::vector<std::string>& part_name,
                      const std::optional<occt::SymmetryPlane>& plane, const std::optional<occt::FarField>& far,
                      std::vector<ImportFinding>& findings);

}  // namespace st
