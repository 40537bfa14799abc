// The size field of an octree that moved with its geometry: tables stay, queries are brought back into its frame.
#pragma once

#include <memory>

#include "sizing/octree_field.h"

namespace st {

/// As OctreeField, of an octree of which the point x lies at frame(x) in the model; lengths grow with the frame's
/// scale, the slope stays. A query costs a matrix product more.
class MovedOctreeField : public OctreeField {
 public:
  MovedOctreeField(const OctreeFieldData& data, std::shared_ptr<const void> owner, double min_length,
                   const Similarity& frame)
      : OctreeField(data, std::move(owner), min_length), frame_(frame), to_octree_(frame.inverse()) {}

  using OctreeField::size;
  double size(Vec3 xyz, int& hint) const override { return frame_.scale * OctreeField::size(to_octree_(xyz), hint); }
  LocalSize local(Vec3 xyz, int& hint) const override { return local_on(xyz, {}, hint); }
  LocalSize local_on(Vec3 xyz, Vec3 normal, int& hint) const override;
  double min_size() const override { return frame_.scale * OctreeField::min_size(); }
  Similarity frame() const override { return frame_; }
  SizeExplanation explain(Vec3 xyz, Vec3 normal = {}) const override;

 private:
  Similarity frame_, to_octree_;
};

/// An OctreeField, or a MovedOctreeField where `frame` moves anything.
std::unique_ptr<OctreeField> make_octree_field(const OctreeFieldData& data, std::shared_ptr<const void> owner,
                                               double min_length, const Similarity& frame);

}  // namespace st
