// Trimming curves through projected points.
#pragma once

#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Curve.hxx>
#include <functional>
#include <map>

#include "geometry/shape/surface.h"

namespace st::occt {

/// A space curve and its parameters, to be trimmed to.
struct CurveRange {
  Handle(Geom_Curve) curve;
  double t0 = 0, t1 = 0;
};

using UvPoints = std::map<double, Vec2>;  ///< by parameter

/// A cubic spline through the points, those within `tolerance` of each other being one; null where there is none, as
/// through points that coincide at a pole.
Handle(Geom2d_BSplineCurve) spline_through(const UvPoints& points, double tolerance);
/// Straight from each point to the next.
Handle(Geom2d_BSplineCurve) polygon_through(const UvPoints& points);

/// Trimming curve of the same parameter: a line where the projections run evenly along one, else a cubic through the
/// projections of points of the space curve, more of them where it leaves the curve by more than `target` (model unit).
/// `guess(t)` is a (u,v) near the projection, and in its period. Null when a point has no projection near.
Handle(Geom2d_Curve) fit_pcurve(const CurveRange& range, const Surface& surface,
                                const std::function<Vec2(double)>& guess, double target);

}  // namespace st::occt
