// Trimming curves by projection.
#pragma once

#include <Geom2d_BSplineCurve.hxx>

#include "geometry/shape/curve.h"
#include "geometry/shape/surface.h"

namespace st::occt {

struct TrimmingCurve {
  Handle(Geom2d_BSplineCurve) curve;  ///< parametrised like the space curve
  double distance = 0;                ///< largest between space curve and surface at the trimming curve (model unit)
  Vec3 xyz;                           ///< where
};

/// The curve's projection: a cubic through as many points as it takes to come within `resolution` (model unit) of what
/// the projected points themselves leave. Points closer than that to a side of the surface come to lie on it; where a
/// side is a point in space, the curve goes on in the direction it came from. Parameters go on beyond the bounds where
/// the surface has a period.
TrimmingCurve project_curve(const Surface& surface, const Curve& curve, double resolution);

/// The straight line from `a` at 0 to `b` at `t_max` > 0.
Handle(Geom2d_BSplineCurve) straight_pcurve(Vec2 a, Vec2 b, double t_max);

}  // namespace st::occt
