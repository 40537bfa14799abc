// Which faces belong to one body, and where they meet.
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "geometry/model/model.h"

namespace st {

/// Body of each face: its solid, or without one the shell that it is in. [n_faces], kNone: neither.
std::vector<std::int32_t> bodies_of(const ModelTables& tables);

/// Vertices of the face's edges.
std::set<VertexId> vertices_of(const ModelTables& tables, FaceId face);

/// The distance up to which walls of these faces meet: a millionth of the diagonal, or what the CAD leaves open.
double meeting_distance(const ModelTables& tables, FaceId a, FaceId b);

}  // namespace st
