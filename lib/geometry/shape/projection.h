// The closest point of a bounded surface or curve, found without a guess. For a guess there is project_near(); this is
// for the few points that have none.
#pragma once

#include <optional>
#include <vector>

#include "geometry/shape/curve.h"
#include "geometry/shape/surface.h"

namespace st {

/// Closest point of a surface within its bounds.
struct SurfaceFoot {
  Vec2 uv;
  Vec3 x;
  double distance;  ///< model unit
};

/// By formula where exact_foot() gives a point within the bounds; else constrained Newton from the closest samples of a
/// grid that has two intervals per polynomial piece, sides and corners included. Of equally close points the one found
/// first. Cost: the grid, tens of microseconds to milliseconds.
SurfaceFoot closest_point(const Surface& surface, Vec3 p);

/// Where a surface is sampled: a grid of parameters, and the points there, rows in v. Empty until it is used.
struct SurfaceGrid {
  std::vector<double> u, v;
  std::vector<Vec3> x;
};

/// The same point of a surface that is asked for many: `grid`, of this surface alone, is made for the first and kept.
SurfaceFoot closest_point(const Surface& surface, Vec3 p, SurfaceGrid& grid);

/// Likewise by constrained Newton from a guess alone, which is first moved into the bounds: a local minimum.
SurfaceFoot descend_from(const Surface& surface, Vec3 p, Vec2 guess);

/// A point above a surface.
struct PointAbove {
  Vec3 foot;        ///< in the surface's tangent plane next to it
  Vec3 normal;      ///< du x dv there
  double distance;  ///< of the point from the plane, model unit
};

/// Of a point near the surface, by a few steps in tangent planes from the guess (u,v): until the foot lies beside the
/// surface's point by no more than `aside`, so that it is off the surface by half the curvature times its square.
/// nullopt where that takes more than three steps, leaves the bounds, or meets a singular point. Local, fast.
std::optional<PointAbove> point_above(const Surface& surface, Vec3 p, Vec2 guess, double aside);

/// Closest point of a curve within its bounds.
struct CurveFoot {
  double t;
  Vec3 x;
  double distance;  ///< model unit
};
CurveFoot closest_point(const Curve& curve, Vec3 p);

/// Newton projection from the guess `t`, within the bounds enlarged by 1 %. nullopt when it does not converge in 20
/// steps.
std::optional<double> project_near(const Curve& curve, Vec3 p, double guess);

}  // namespace st
