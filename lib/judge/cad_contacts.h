// Are crossing triangles the mesher's doing, or does the CAD touch itself there?
#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "geometry/model/model.h"
#include "judge/facet_crossings.h"
#include "mesh/crossing.h"
#include "mesh/surface_mesh.h"

namespace st {

/// Answers by the intersection of the CAD faces themselves, found once per pair of faces; of a model of facets, by the
/// facets, which never touch but cross. One object serves one mesh, one thread.
class CadContacts {
 public:
  CadContacts(const Model& model, const SurfaceMesh& mesh) : model_(model), mesh_(mesh) {}

  /// The two faces touch (not: cross) within the longest side of both triangles, away from what they share. Of the
  /// pairs of faces after the first kMaxFacePairs it says no.
  bool touches(const TrianglePair& pair);
  /// The same, but the faces cross.
  bool crosses(const TrianglePair& pair);

 private:
  static constexpr std::size_t kMaxFacePairs = 1000;  // some ten milliseconds each
  bool is_near(const TrianglePair& pair, bool passes_through);
  bool is_near_facets(const TrianglePair& pair);
  const std::vector<FaceContact>& contacts(FaceId a, FaceId b);

  const Model& model_;
  const SurfaceMesh& mesh_;
  std::map<std::pair<FaceId, FaceId>, std::vector<FaceContact>> found_;
  std::unique_ptr<FacetCrossings> of_facets_;  // found when first needed
};

}  // namespace st
