// Bodies that pass through each other, or through themselves.
#pragma once

#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"
#include "geometry/model/model_tables.h"

namespace st::occt {

/// An edge of one body goes through a face of another one, or of its own away from what they share.
struct BodyCrossing {
  FaceId of_edge = kNone, face = kNone;  ///< a face that has the edge; the face that it passes through
  Vec3 xyz;                              ///< there, model unit
};

struct CrossingBodies {
  std::vector<BodyCrossing> found;  ///< one place for each pair of bodies, in the order of the faces
  int n_not_compared = 0;           ///< pairs of bodies of which not all could be compared
};

/// All pairs of bodies that cross. Bodies are solids. `measures` and `tables` are those of `model`. Edges and faces are
/// compared where their boxes meet, for each pair of bodies until kMostCrossingTests are done, and of all pairs until
/// kMostCrossingTestsOfAll are: a plane counts 8, other surfaces of a formula 200, splines 400. All pairs get their
/// first tests before any gets its last.
CrossingBodies find_crossing_bodies(const ImportedShape& model, const ModelTables& tables,
                                    const FaceMeasures& measures);

inline constexpr int kMostCrossingTests = 20000;
inline constexpr int kMostCrossingTestsOfAll = 100000;

}  // namespace st::occt
