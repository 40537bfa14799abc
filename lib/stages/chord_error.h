// How far a mesh of chords may differ from the CAD it was made on.
#pragma once

#include <vector>

#include "geometry/model.h"
#include "mesh/surface_mesh.h"

namespace st {

/// What chords explain, per CAD face.
struct ChordError {
  std::vector<double> area;      ///< [n_faces] largest difference of area that chords of this length explain, model unit squared
  std::vector<double> distance;  ///< [n_faces] largest distance found between a triangle's side and the surface, model unit
};

/// Along edges: the segments between chord and arc. Inside: triangles against their halves on the surface at the middle of their sides in
/// (u,v), extrapolated. Precondition: `mesh` was made on `model`. Local; three surface evaluations per triangle of a curved face.
ChordError estimate_chord_error(const Model& model, const SurfaceMesh& mesh);

}  // namespace st
