// The loops of a face as polygons in (u,v): what is inside, and which sides cross.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "base/vec.h"

namespace st {

/// A side of a loop polygon.
struct LoopSide {
  Vec2 a, b;
  CoedgeId coedge = kNone;  ///< on whose trimming curve it lies, if that is known
};

/// All loops of a face as sides in (u,v), searchable by v. Without sides the whole parameter rectangle is inside.
class LoopPolygons {
 public:
  LoopPolygons() = default;
  explicit LoopPolygons(std::vector<LoopSide> sides);

  const std::vector<LoopSide>& sides() const { return sides_; }
  /// Inside by the even-odd rule; on a side either answer.
  bool contains(Vec2 uv) const;

 private:
  std::vector<LoopSide> sides_;
  double v_min_ = 0, bins_per_v_ = 0;
  std::vector<std::int32_t> bin_offsets_, bin_sides_;  // CSR: sides that meet each strip of v
};

/// Do the two sides cross properly: neither touches the other with an end?
bool cross_properly(const LoopSide& s, const LoopSide& r);

/// Pairs of sides that cross properly, the smaller number first, ascending. Cost: near linear for loops of short sides.
std::vector<std::pair<std::int32_t, std::int32_t>> crossing_sides(std::span<const LoopSide> sides);

}  // namespace st
