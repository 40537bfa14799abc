// Which faces belong to one body.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/model/model.h"

namespace st {

/// Body of each face: its solid, or without one the shell that it is in. [n_faces], kNone: neither.
std::vector<std::int32_t> bodies_of(const ModelTables& tables);

/// The distance up to which walls of these faces meet: a millionth of the diagonal, or what the CAD leaves open.
double meeting_distance(const ModelTables& tables, FaceId a, FaceId b);

}  // namespace st
