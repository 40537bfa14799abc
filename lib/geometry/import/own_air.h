// Is the model the air around a body? From topology and shape, where no name says so.
#pragma once

#include <string>
#include <vector>

#include "geometry/model/imported_shape.h"
#include "geometry/model/model.h"

namespace st::occt {

enum class AirSearch {
  kSure,  ///< only what no machine part looks like
  kAsked  ///< the user says that the model has its air: any closed boundary around something smaller
};

/// What bounds the air; faces ascending.
struct OwnAir {
  std::vector<FaceId> farfield, symmetry;
  std::vector<FaceId> interface;  ///< air on both sides: boxes inside the domain, cuts through it, sheets to its sides
  std::string doubt;  ///< where nothing is found: why what looks like a domain is taken for a part; or empty
  bool is_found() const { return !farfield.empty(); }
};

/// One set of connected faces has to reach all sides of the model's box, closed and convex, and all others, the body,
/// are inside. The body is inside, or stands on one or two planes that hold large faces of the hull: these count apart,
/// so that body and outer faces part there, and become symmetry planes. With kSure also: the body is small and away
/// from the far field, no outer face is a rounding, and the body is no pocket or pore of a machine part: it has a face
/// of free form, or one turned about an axis in a symmetry plane, or it is smaller still. All measures are the same
/// however the model is turned. Cost: linear in the coedges, at most 79 times.
OwnAir find_own_air(const ImportedShape& model, const ModelTables& tables, AirSearch search);

}  // namespace st::occt
