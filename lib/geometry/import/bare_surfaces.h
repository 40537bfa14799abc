// Spline surfaces that are a whole body, or a skin with its caps.
#pragma once

#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// Divides faces outside solids that are whole spline surfaces, without trimming, at their knots where the surface has
/// a kink (of kLeastKink) or is shrunk to a point: the rim of a cap, the end of a middle line that two halves of a cap
/// have in common. Each such face is a finding; its parts have its
/// name, those without area are left out. An open surface alone stays. Edges that run there and back become two, which
/// sewing can join.
void divide_bare_surfaces(ImportedShape& model, std::vector<ImportFinding>& findings);

inline constexpr double kLeastKink = 0.35;  // radians, 20 degrees: between sections of a wing are less

}  // namespace st::occt
