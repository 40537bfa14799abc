// Ferguson (composite cubic Hermite) curves and surfaces, one unit of parameter per span, as the B-splines they are: degree 3, each inner
// knot twice. Their evaluators are those of bspline.h.
#pragma once

#include <memory>
#include <span>

#include "geometry/bspline.h"

namespace st {

/// Curve through `points` with the derivatives `tangents` there, t from 0 to points.size() - 1. Precondition: at least two points, as many
/// tangents.
std::unique_ptr<BsplineCurve> ferguson_curve(std::span<const Vec3> points, std::span<const Vec3> tangents);

/// Values and derivatives at the points of a grid [n_v][n_u], u fastest.
struct FergusonGrid {
  int n_u, n_v;
  std::span<const Vec3> x, xu, xv, xuv;
};

/// Bicubic surface through a grid, u from 0 to n_u - 1 and v from 0 to n_v - 1. Precondition: n_u, n_v >= 2, n_u * n_v of each.
std::unique_ptr<BsplineSurface> ferguson_surface(const FergusonGrid& grid);

}  // namespace st
