// Shapes that are moved and scaled.
#pragma once

#include <BRepBuilderAPI_Transform.hxx>
#include <TopoDS_Shape.hxx>
#include <gp_Trsf.hxx>

namespace st::occt {

/// A copy of the shape as `motion` moves and scales it, whose trimming curves have the parameter of their edges as
/// before. Where a surface scales along one parameter alone, as a cylinder does, OpenCASCADE makes a rational spline of
/// an ellipse, with a parameter of its own. Throws Standard_Failure.
BRepBuilderAPI_Transform scaled_shape(const TopoDS_Shape& shape, const gp_Trsf& motion);

}  // namespace st::occt
