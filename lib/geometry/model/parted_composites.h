// Composites some of which are the CAD's faces again.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/model/composites.h"
#include "geometry/model/model.h"

namespace st {

/// Marks in `is_apart` ([c.size()]) composites that have one of `faces` as a member, but the lowest one: where they are
/// one face, nothing is on the others.
void mark_apart(const Composites& c, std::span<const FaceId> faces, std::vector<std::uint8_t>& is_apart);

/// Composites that are not marked. Edges go on as one only where no edge of a face that is alone again ends. `cad`:
/// tables that `c` does not contradict.
Composites without(const Composites& c, const std::vector<std::uint8_t>& is_apart, const ModelTables& cad);

}  // namespace st
