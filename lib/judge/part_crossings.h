// Do parts that were put together, or moved, now cross each other? Internal to stages.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/model/model.h"

namespace st {

struct PartCrossing {
  FaceId first = kNone, second = kNone;
  Vec3 xyz;         ///< on both, model unit
  double size = 0;  ///< extent of where they meet, model unit
};

struct PartCrossings {
  std::vector<PartCrossing> found;  ///< by faces; the first kMaxCrossings
  std::size_t n_near = 0;           ///< pairs of faces whose boxes meet
  std::size_t n_compared = 0;       ///< of these
};

inline constexpr std::size_t kMaxCrossings = 10, kMaxComparedPairs = 300;  // milliseconds to a second each

/// Faces of different placement that pass through each other (not: touch, or end on each other). `placement`,
/// [n_faces]: faces of equal numbers came and moved together. Pairs are compared in the order of their ids until one of
/// the limits above.
PartCrossings find_part_crossings(const Model& model, std::span<const std::int32_t> placement);

}  // namespace st
