// Are faces or whole bodies of parts that were put together, or moved, now at one place? Internal to stages.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geometry/model/model.h"

namespace st {

struct SamePlaces {
  std::vector<std::pair<FaceId, FaceId>> faces;   ///< of different placement, the smaller id first, ascending
  std::vector<std::pair<FaceId, FaceId>> bodies;  ///< a face each of two bodies all of whose faces are among them
};

/// Faces of different placement with the same box, area and surface, whose outlines lie on each other. `placement`,
/// [n_faces]: faces of equal numbers came and moved together. Bodies are solids, or shells that are in none. Cost:
/// boxes are sorted; surfaces only where boxes agree.
SamePlaces find_same_places(const Model& model, std::span<const std::int32_t> placement);

}  // namespace st
