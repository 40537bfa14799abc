// Parts of models and models put together: B-Rep, tables and groups stay consistent. Nothing is changed in place.
#pragma once

#include <span>
#include <vector>

#include "base/similarity.h"
#include "geometry/model/model.h"

namespace st {

/// A part of a model. `faces`, `edges` and `vertices` name, for each entity of `model`, the one of the whole that it
/// was.
struct SubModel {
  Model model;
  std::vector<FaceId> faces;
  std::vector<EdgeId> edges;
  std::vector<VertexId> vertices;
};

/// The faces named, in this order, with their edges and vertices only. All groups stay; shells and solids keep their
/// numbers, but a shell may be open now, so the part has no volume. Cost: that of the part; for one face 0.1 to 0.3 ms.
/// Throws Error(kUsage) for an unknown face, one named twice, or none.
SubModel extract(const Model& model, std::span<const FaceId> faces);

/// The model moved; ids, names and groups stay, normals point out of the solids as before. Throws Error(kGeometry).
Model transform(const Model& model, const Similarity& motion);

/// By how much u and v of a face of `model` grow where it is scaled: both of a plane, v of a cylinder, none of a
/// B-spline.
Vec2 parameter_growth(const Model& model, FaceId f, double scale);

/// Some faces moved, the others as they are: ids, names and groups stay. Volume: that of `model` unless the motion
/// scales. Throws Error(kUsage) for faces as extract() does, Error(kGeometry) for faces that share edges or vertices
/// with others, which would tear.
SubModel transform_faces(const Model& model, std::span<const FaceId> faces, const Similarity& motion);

/// Both models side by side: the entities of `second` after those of `first`, groups of the same name and role become
/// one. Nothing is sewn. Throws Error(kMismatch) when the units differ.
Model append(const Model& first, const Model& second);

}  // namespace st
