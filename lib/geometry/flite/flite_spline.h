// Composite Ferguson curves and surfaces as the B-splines they are: C2 cubics through points, one unit of parameter
// from each to the next, without curvature at their ends.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "geometry/shape/bspline.h"

namespace st {

/// Poles of the cubic through `points` at the parameters 0, 1, 2 ... whose second derivative vanishes at both ends: as
/// many plus two, on the knots 0 0 0 0 1 2 ... n n n n. Of two points: these, degree 1. Precondition: at least two
/// points.
std::vector<Vec3> natural_spline_poles(std::span<const Vec3> points);

/// Degree of the curve through so many points, and number of its poles.
inline int natural_spline_degree(int n_points) { return n_points == 2 ? 1 : 3; }
inline int natural_spline_n_poles(int n_points) { return n_points == 2 ? 2 : n_points + 2; }

/// Poles [n_v poles][n_u poles], u fastest, of the natural splines along both directions of a grid of points
/// [n_v][n_u], u fastest: the bicubic Hermite form whose twists are those of the spline of derivatives. Precondition:
/// n_u, n_v >= 2.
std::vector<Vec3> natural_surface_poles(int n_u, int n_v, std::span<const Vec3> points);

/// Evaluators, t from 0 to points.size() - 1; u from 0 to n_u - 1, v from 0 to n_v - 1.
std::unique_ptr<BsplineCurve> ferguson_curve(std::span<const Vec3> points);
std::unique_ptr<BsplineSurface> ferguson_surface(int n_u, int n_v, std::span<const Vec3> points);

}  // namespace st
