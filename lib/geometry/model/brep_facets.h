// Facets on shapes of OpenCASCADE: include it in sources of geometry/model only.
#pragma once

#include <TopoDS_Shape.hxx>

#include "geometry/model/facets.h"

namespace st {

/// What faces and edges get of it.
enum class FacetsGo {
  kToFaces,     ///< triangles
  kToAllEdges,  ///< polygons of edges on the triangles as well
};

/// Puts triangles onto the faces of a shape, face by face on all threads; the same at any number of them.
void put_facets(const TopoDS_Shape& shape, const FacetLimits& limits, FacetsGo go);

}  // namespace st
