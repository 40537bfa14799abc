// Vertices at which edges go on as one, once the edges that ended there are gone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/model/model.h"

namespace st {

/// Ascending. `joined_edges` go; `part_of`: [n_faces] the lowest face of the part that each is joined to, itself alone.
/// Two edges are left there, between the same parts, which turn by 3 degrees at most and have no name; in faces that
/// stay alone their trimming curves meet. Not where `must_end` ([n_vertices] 1); a ring keeps a vertex. Local.
std::vector<VertexId> find_passed_vertices(const Model& cad, std::span<const EdgeId> joined_edges,
                                           std::span<const FaceId> part_of, std::span<const std::uint8_t> must_end);

}  // namespace st
