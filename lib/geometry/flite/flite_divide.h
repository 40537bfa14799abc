// Models made fit for Ferguson surfaces: no closed face, no kink inside a face or an edge.
#pragma once

#include <vector>

#include "geometry/model/model.h"

namespace st {

struct DividedModel {
  Model model;
  std::vector<FaceId> origin;  ///< [faces of `model`] the face of the whole that each one is of
};

/// Closed faces in two halves, faces and edges divided where their derivative jumps. Faces stay in order. A model that
/// needs neither comes back as it is. Throws Error(kGeometry) when OpenCASCADE fails on it.
DividedModel divide_for_flite(const Model& model);

}  // namespace st
