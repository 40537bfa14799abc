// Faces that pass through each other beside their common edge, and faces that pass through themselves.
#pragma once

#include <vector>

#include "geometry/model/imported_shape.h"
#include "geometry/model/model_tables.h"

namespace st::occt {

/// A point of both surfaces, inside both faces, away from their common edges.
struct FaceCrossing {
  FaceId first = kNone, second = kNone;  ///< equal: the face passes through itself
  bool is_pinch = false;                 ///< it shrinks to a point, beyond which it is turned over
  bool is_fold = false;                  ///< an offset beyond the radius of its basis: it goes back on itself there
  Vec3 xyz;                              ///< model unit
  double size = 0;          ///< distance from the common edge; of one face: how far it goes away in between
  bool is_overlap = false;  ///< beside the edge they lie on each other, within the CAD's tolerance
};

/// One place for each face or pair of neighbours, at most. Faces and neighbours of faces without a formula (splines,
/// revolutions, offsets) are looked at; all for those that lie on each other. `tables` are those of `model`.
std::vector<FaceCrossing> find_crossing_faces(const ImportedShape& model, const ModelTables& tables);

}  // namespace st::occt
