// The size field of an octree: a lookup and a linear function.
#pragma once

#include <memory>

#include "sizing/octree.h"
#include "sizing/size_field.h"

namespace st {

/// Arrays and numbers of a prolonged octree.
struct OctreeFieldData {
  OctreeView octree;
  std::span<const CellLength> cells;    ///< [n_leaves]
  std::span<const std::int32_t> cause;  ///< [n_leaves]; see pack_cause
  double slope = 0;                     ///< largest change of length per distance
  double scale = 1;                     ///< multiplies every answer
};

/// What stands behind the length at a place.
struct SizeExplanation {
  std::int32_t leaf = 0;
  int level = 0;
  double cell_edge = 0;  ///< model unit
  double length = 0;     ///< as size() answers
  Vec3 gradient;
  std::int32_t cause = kNone;  ///< see pack_cause
};

/// h(x) = min(length + gradient . (x - centre), upper) of the leaf at x, times scale. Never leaves the range of the lengths of the leaf and
/// its neighbours.
class OctreeField : public SizeField {
 public:
  /// `owner` keeps the arrays alive (vectors, a mapped artifact). Precondition: arrays as prolong() makes them. O(n): looks for the
  /// smallest length, unless `min_length` (before scale) is known.
  OctreeField(const OctreeFieldData& data, std::shared_ptr<const void> owner, double min_length = 0);

  using SizeField::size;
  double size(Vec3 xyz, int& hint) const override;
  double min_size() const override { return min_size_; }
  double slope() const override { return data_.slope * data_.scale; }
  const OctreeFieldData& data() const { return data_; }
  SizeExplanation explain(Vec3 xyz) const;
  /// Likewise size(), and its gradient.
  double size_and_gradient(Vec3 xyz, int& hint, Vec3& gradient) const;

 private:
  OctreeFieldData data_;
  std::shared_ptr<const void> owner_;
  double unit_;     // edge of a grid cell
  double to_grid_;  // 1 / unit_
  double min_size_ = 0;
};

}  // namespace st
