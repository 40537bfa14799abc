// Parts of models and models put together: B-Rep, tables and groups stay consistent. Nothing is changed in place.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/model.h"

namespace st {

/// A part of a model. `faces`, `edges` and `vertices` name, for each entity of `model`, the one of the whole that it was.
struct SubModel {
  Model model;
  std::vector<FaceId> faces;
  std::vector<EdgeId> edges;
  std::vector<VertexId> vertices;
};

/// The faces named, in this order, with their edges and vertices only. All groups stay; shells and solids keep their numbers, but a shell
/// may be open now, so the part has no volume. Cost: that of the part; for one face 0.1 to 0.3 ms.
/// Throws Error(kUsage) for an unknown face, one named twice, or none.
SubModel extract(const Model& model, std::span<const FaceId> faces);

/// All faces but those named. Throws Error(kUsage) for an unknown face, and when none would stay.
SubModel remove_faces(const Model& model, std::span<const FaceId> faces);

/// x -> a x + shift; `a` by rows.
struct AffineMap {
  std::array<Vec3, 3> a{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  Vec3 shift;
  Vec3 operator()(Vec3 x) const { return Vec3{dot(a[0], x), dot(a[1], x), dot(a[2], x)} + shift; }
};

/// The model moved, turned, mirrored or scaled alike in all directions; ids, names and groups stay, normals point out of the solids as
/// before. Throws Error(kUsage) for a map that changes angles, since surfaces of revolution and offsets would not stay what they are.
Model transform(const Model& model, const AffineMap& map);

/// Both models side by side: the entities of `second` after those of `first`, groups of the same name and role become one. Nothing is sewn.
/// Throws Error(kMismatch) when the units differ.
Model append(const Model& first, const Model& second);

}  // namespace st
