#include "sizing/moved_field.h"

#include <utility>

namespace st {

LocalSize MovedOctreeField::local_on(Vec3 xyz, Vec3 normal, int& hint) const {
  const LocalSize own = OctreeField::local_on(to_octree_(xyz), to_octree_.rotated(normal), hint);
  return {frame_.scale * own.length, frame_.scale * own.along, frame_.rotated(own.direction)};
}

SizeExplanation MovedOctreeField::explain(Vec3 xyz, Vec3 normal) const {
  SizeExplanation e = OctreeField::explain(to_octree_(xyz), to_octree_.rotated(normal));
  e.cell_edge *= frame_.scale;
  e.length *= frame_.scale;
  e.along *= frame_.scale;
  e.direction = frame_.rotated(e.direction);
  e.origin = frame_(e.origin);
  e.origin_length *= frame_.scale;
  e.gradient = frame_.rotated(e.gradient);  // lengths and distances are scaled alike
  return e;
}

std::unique_ptr<OctreeField> make_octree_field(const OctreeFieldData& data, std::shared_ptr<const void> owner,
                                               double min_length, const Similarity& frame) {
  if (frame == Similarity()) return std::make_unique<OctreeField>(data, std::move(owner), min_length);
  return std::make_unique<MovedOctreeField>(data, std::move(owner), min_length, frame);
}

}  // namespace st
