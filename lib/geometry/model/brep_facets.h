// Facets on shapes of OpenCASCADE: include it in sources of geometry/model only.
#pragma once

#include <BRepMesh_IncrementalMesh.hxx>
#include <IMeshTools_Parameters.hxx>
#include <TopoDS_Shape.hxx>

#include "geometry/model/facets.h"

namespace st {

/// Puts triangles onto the faces of a shape.
inline void put_facets(const TopoDS_Shape& shape, const FacetLimits& limits) {
  IMeshTools_Parameters parameters;
  parameters.Deflection = limits.deflection;
  parameters.Angle = limits.angle;
  parameters.ControlSurfaceDeflection = limits.is_exact;
  const BRepMesh_IncrementalMesh mesher(shape, parameters);
}

}  // namespace st
