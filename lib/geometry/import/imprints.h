// Faces that end or lie on the inside of others.
#pragma once

#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

enum class Imprints {
  kEdges,         ///< free edges on faces
  kEdgesAndFaces  ///< and faces on faces, of shells with an edge of three faces
};

/// Divides faces along free edges of others that run over their inside, and faces that lie on each other in part or
/// under other edges, so that both have what is common in common: a rib on a skin, bodies of loose faces that touch.
/// `tolerance`: largest distance, unit of the shape, positive. Each such face is a finding, with what it lies on;
/// where OpenCASCADE cannot divide them, or would change an area, all stay as they are, and that is the finding. Faces
/// that changed are in shells of those that have edges in common, at the place of the first. Bodies with voids are left
/// alone. Returns whether anything changed. Cost: boxes of edges and faces, points of edges in the box of a face.
bool imprint_faces(ImportedShape& model, Imprints which, double tolerance, std::vector<ImportFinding>& findings);

}  // namespace st::occt
