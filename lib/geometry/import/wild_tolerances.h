// Tolerances that sewing left beyond reason.
#pragma once

#include <TopoDS_Shape.hxx>

namespace st::occt {

/// Sewing measures at equal parameters: where partners run at different speeds it leaves tolerances as long as the
/// edge. Edges above `limit` get the sewing tolerance, their vertices what their curves need; repair_pcurves() then
/// compares, projects again and raises what must be.
void tighten_tolerances(const TopoDS_Shape& shape, double sewing_tolerance, double limit);

}  // namespace st::occt
