// The shape of a row's quadrilaterals. Internal to lib/meshing.
#pragma once

#include "base/local_size.h"
#include "base/vec.h"
#include "meshing/face/triangulation.h"
#include "sizing/size_field.h"

namespace st {

/// Is a quadrilateral, counter-clockwise, convex in the plane and near to a rectangle in space?
bool is_upright(const MeshNode& a, const MeshNode& b, const MeshNode& c, const MeshNode& d);

/// Whether rows along one of these directions, and up the other, are so oblique to metrics in space that their
/// triangles are flat; false where the field has none. `local`: the sizes there.
bool is_oblique(const SizeField& field, const LocalSize& local, Vec3 along, Vec3 up);

}  // namespace st
