// Which faces are images of one another.
#pragma once

#include <span>
#include <vector>

#include "geometry/model/model.h"
#include "mesh/face_pair.h"

namespace st {

/// A pair for each face of `a`: the face of `b` whose vertices are nearest to the image's, of those that no earlier one
/// has. Throws Error(kGeometry) where both have not as many faces. Whether they match is for PeriodicPairs to say.
std::vector<FacePair> pair_faces(const ModelTables& tables, std::span<const FaceId> a, std::span<const FaceId> b,
                                 const Similarity& motion);

/// Faces that one translation, or else one rotation about the x, y or z axis, turns into each other with their outsides
/// against each other. Only those of groups with the role "periodic"; where there is none, all but those of the roles
/// farfield, symmetry, inlet and outlet. Angles next to the n-th part of a turn are that part. By face a, the lower id.
/// Throws Error(kGeometry) where a face fits several, or none fits. Local, n^2 in the faces of equal areas.
std::vector<FacePair> find_pairs(const Model& model);

}  // namespace st
