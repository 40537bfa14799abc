// Where stretched lengths do not fit the surface: obtuse triangles, and neighbours of very different size.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mesh/surface_mesh.h"
#include "meshing/face/face_mesher.h"
#include "sizing/size_field.h"

namespace st {

struct StretchFlaws {
  // in the order of the triangles
  std::vector<RefinementPoint> stretched;  ///< where lengths along should be shorter
  std::vector<RefinementPoint> obtuse;     ///< where triangles are, although lengths are alike in all directions
  std::size_t n_triangles = 0;  ///< with an angle above 140 degrees, or 2.2 squared times the area of a neighbour
};

/// `present`: the lengths that the triangles were made for. Local, linear.
StretchFlaws find_stretch_flaws(std::span<const Vec3> points, std::span<const Triangle> triangles,
                                const SizeField& present);

}  // namespace st
