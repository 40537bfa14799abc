// A size field made finer around given places.
#pragma once

#include <algorithm>
#include <vector>

#include "meshing/face_mesher.h"
#include "sizing/size_field.h"

namespace st {

/// Slope with which the length grows away from a refinement point.
inline constexpr double kRefinementSlope = 0.3;

/// min(base, length_i + slope * distance to point i). Precondition: `base` outlives it. Cost: linear in the points; give it those in reach only.
class RefinedField : public SizeField {
 public:
  RefinedField(const SizeField& base, std::vector<RefinementPoint> points) : base_(base), points_(std::move(points)) {}
  using SizeField::size;
  double size(Vec3 xyz, int& hint) const override {
    double h = base_.size(xyz, hint);
    for (const RefinementPoint& p : points_) h = std::min(h, p.length + kRefinementSlope * distance(xyz, p.x));
    return h;
  }
  double min_size() const override {
    double h = base_.min_size();
    for (const RefinementPoint& p : points_) h = std::min(h, p.length);
    return h;
  }
  double slope() const override { return std::max(base_.slope(), kRefinementSlope); }

 private:
  const SizeField& base_;
  std::vector<RefinementPoint> points_;
};

}  // namespace st
