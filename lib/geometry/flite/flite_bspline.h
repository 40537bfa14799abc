// Composite Ferguson curves and surfaces in OpenCASCADE's form.
#pragma once

#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <span>

#include "base/vec.h"

namespace st::occt {

/// See flite_spline.h; the same poles and knots.
Handle(Geom_BSplineCurve) bspline_curve(std::span<const Vec3> points);
Handle(Geom_BSplineSurface) bspline_surface(int n_u, int n_v, std::span<const Vec3> points);

}  // namespace st::occt
