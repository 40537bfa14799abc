// Holes marked on one rank.
#pragma once

#include <span>

#include "meshing/hole/hole_marks.h"

namespace st::test {

inline HoleMarks mark_holes(const HoleMesh& mesh, std::span<const double> wanted, const HoleMarkOptions& options) {
  return mark_share(mesh, {0, static_cast<TriangleId>(mesh.mesh.triangles.size()), 0}, wanted, options, {});
}

}  // namespace st::test
