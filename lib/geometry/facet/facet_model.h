// A model from facets: charts as faces, lines between them as edges.
#pragma once

#include <string>
#include <vector>

#include "geometry/facet/facet_mesh.h"
#include "geometry/model/facet_shape.h"
#include "geometry/model/model.h"

namespace st {

struct FacetModel {
  ModelTables tables;  ///< without unit; a group for each name of a part
  FacetShape shape;
};

/// Precondition: the faces of `mesh` are charts, numbered from 0. Lines end where not two of them meet and where they
/// turn by more than `feature` (radians). Connected faces are a shell, a closed shell a solid.
FacetModel make_facet_model(const FacetMesh& mesh, const std::vector<std::string>& part_name, double feature);

}  // namespace st
