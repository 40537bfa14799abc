// Spline surfaces that are a whole body, or a skin with its caps.
#pragma once

#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// Whether there was any, and whether parts without area were left out.
struct DividedSurfaces {
  bool any = false, has_empty_parts = false;
};

/// Divides faces outside solids that are whole spline surfaces, without trimming, and would not close: at their knots
/// where the surface is a point (the end of a middle line that two halves of a cap have in common), beside parts
/// without area, and where a side runs there and back: it becomes two edges, which sewing can join. Such a face is
/// divided at kinks of kLeastKink, too: the rims of its caps. Each is a finding; its parts have its name, those without
/// area are left out.
DividedSurfaces divide_bare_surfaces(ImportedShape& model, std::vector<ImportFinding>& findings);

}  // namespace st::occt
