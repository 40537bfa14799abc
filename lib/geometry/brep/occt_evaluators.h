// OpenCASCADE geometry to our evaluators.
#pragma once

#include <Geom2d_Curve.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <memory>

#include "base/boxes.h"
#include "geometry/shape/curve.h"
#include "geometry/shape/surface.h"

namespace st::occt {

/// Own evaluator where one pays, OpenCASCADE's adaptor otherwise.
std::unique_ptr<Curve> make_curve(const Handle(Geom_Curve) & curve, double t_min, double t_max);
std::unique_ptr<Curve2d> make_curve2d(const Handle(Geom2d_Curve) & curve, double t_min, double t_max);
std::unique_ptr<Surface> make_surface(const Handle(Geom_Surface) & surface, const Box2& bounds);
/// Within its own bounds.
std::unique_ptr<Surface> make_surface(const Handle(Geom_Surface) & surface);

/// Kind of the basis surface (trimming unwrapped).
SurfaceType surface_type(const Handle(Geom_Surface) & surface);

}  // namespace st::occt
