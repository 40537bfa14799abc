// The size field of a periodic model: both sides of a pair ask for the same.
#pragma once

#include <utility>
#include <vector>

#include "base/similarity.h"
#include "base/vec.h"
#include "sizing/size_field.h"

namespace st {

/// Two regions of which one is the other's image.
struct PairedRegion {
  Box3 a, b;          ///< of the faces
  Similarity motion;  ///< from a to b
};

/// In the boxes of paired faces the smallest length asked for at a point and at its images, elsewhere that of `base`. A
/// stretched length comes with its direction, turned back. A query in a box costs one of `base` for each image, at most
/// eight.
class PairedField : public SizeField {
 public:
  /// `base` outlives the object. Boxes are enlarged by `tolerance`, model unit.
  PairedField(const SizeField& base, const std::vector<PairedRegion>& regions, double tolerance);
  using SizeField::size;
  double size(Vec3 xyz, int& hint) const override { return local(xyz, hint).length; }
  LocalSize local(Vec3 xyz, int& hint) const override { return local_on(xyz, {}, hint); }
  LocalSize local_on(Vec3 xyz, Vec3 normal, int& hint) const override;
  bool has_metrics() const override { return base_.has_metrics(); }
  bool is_stretched() const override { return base_.is_stretched(); }
  double min_size() const override { return base_.min_size(); }
  double slope() const override { return base_.slope(); }

 private:
  struct Way {  // out of one box
    Box3 box;
    Similarity motion;
  };
  const SizeField& base_;
  double tolerance_;
  std::vector<Way> ways_;
};

}  // namespace st
