// Do parts that were put together, or moved, now cross each other? Internal to stages.
#pragma once

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "geometry/model/model.h"

namespace st {

struct PartCrossing {
  FaceId first = kNone, second = kNone;
  Vec3 xyz;         ///< on both, model unit
  double size = 0;  ///< extent of where they meet, model unit
};

struct PartCrossings {
  std::vector<PartCrossing> found;  ///< by faces; of two parts the first kMaxCrossings
  std::size_t n_left = 0;           ///< pairs of faces whose boxes meet that were not compared, of other parts
};

inline constexpr std::size_t kMaxCrossings = 10, kMaxComparedPairs = 300;  // milliseconds to a second each

/// Which faces belong together.
struct FaceParts {
  std::vector<std::int32_t> placement;  ///< [n_faces] equal for faces that came and moved together
  std::vector<std::int32_t> part;       ///< [n_faces] equal for those of one body of one placement
  std::set<std::pair<std::int32_t, std::int32_t>> left_out = {};  ///< of parts that are not compared, the smaller first
};

/// Faces of different placement that pass through each other (not: touch, or end on each other). Pairs of parts take
/// turns, each in the order of its faces, so that each gets its share of kMaxComparedPairs.
PartCrossings find_part_crossings(const Model& model, const FaceParts& parts);

}  // namespace st
