// Faces that go around their surface more than once, as those of threads and coils.
#pragma once

#include <TopTools_IndexedMapOfShape.hxx>
#include <vector>

#include "base/vec.h"

namespace st::occt {

/// A face with turns, and its area on one side of a plane.
struct TurnedFace {
  int face = 0;     ///< in the map, from 1
  double area = 0;  ///< model unit squared
};

/// What the faces with turns have where dot(normal, x) > offset: OpenCASCADE's booleans may lose turns, without a word.
/// By facets, scaled to the exact area of the face; where these do not fill it, the face is left out. Faces without
/// turns cost their bounds.
std::vector<TurnedFace> turned_faces_beyond(const TopTools_IndexedMapOfShape& faces, Vec3 normal, double offset);

}  // namespace st::occt
