// Area and volume of trimmed surfaces.
#pragma once

#include <TopoDS_Shape.hxx>

#include "geometry/brep/face_domain.h"

namespace st::occt {

/// Area (model unit squared) and volume of the cone from `origin` over the trimmed surface with the normal du x dv
/// (cubed).
struct FaceIntegral {
  double area = 0, volume = 0;
};

/// By Green's theorem: the boundary integral over the exact trimming curves of the surface's integral along u, both
/// adaptive; relative error below 1e-5 on surfaces with kinks, too.
FaceIntegral integrate_face(const FaceDomain& domain, Vec3 origin);

/// Area of all faces of a shape, or of a face; those without loops have none.
double area_of_faces(const TopoDS_Shape& shape);

}  // namespace st::occt
