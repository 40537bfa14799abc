// The trimming loops of a face as polygons in (u,v).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/model/model.h"
#include "sizing/model_limits.h"

namespace st {

/// A side of a loop polygon.
struct LoopSide {
  Vec2 a, b;
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

/// Sides that properly cross another one (ends that touch do not count), ascending. Cost: near linear for loops of
/// short sides.
std::vector<std::int32_t> crossing_sides(std::span<const LoopSide> sides);

/// Polygons of the face's loops: each coedge at the parameters of its measured curve, refined until the polygon follows
/// the trimming curve within 0.1 % of the face's (u,v) range, and further where sides cross each other.
LoopPolygons loop_polygons(const Model& model, FaceId face, const ModelLimits& limits);

}  // namespace st
