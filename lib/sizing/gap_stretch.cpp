#include "sizing/gap_stretch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "sizing/end_stretch.h"
#include "sizing/line_stretch.h"

namespace st {
namespace {

constexpr double kParallel = 0.02;   // sine between both sides: less tells no direction
constexpr double kWedge = 0.2;       // likewise, 12 degrees: more is a wedge, as wide along its edge alone
constexpr double kChange = 0.3;      // of the gap's width along one length
constexpr double kMuchLonger = 1.5;  // than along the patch's own direction: that fits the lengths beside the gap

Vec3 across(Vec3 d, Vec3 n) { return normalized(d - dot(d, n) * n); }

/// Largest curvature in a tangential direction.
double curvature_in(const Paraboloid& patch, Vec3 u) {
  const double s = dot(u, patch.axis_s), t = dot(u, patch.axis_t);
  return std::abs(patch.k_ss * s * s + 2 * patch.k_st * s * t + patch.k_tt * t * t);
}

class GapStretch {
 public:
  GapStretch(const GapPatch& patch, const GapPlace& place) : patch_(patch), place_(place) {
    opposite_ = place.other->shape.normal_beside(place.met);
    width_ = distance(place.x, place.met);
  }

  SampleStretch run() const {
    const Vec3 crossing = cross(place_.normal, opposite_);
    Vec3 direction;
    double along = 0;
    const std::array directions = {patch_.way, place_.other->way, norm(crossing) > kParallel ? crossing : Vec3{}};
    const bool is_wedge = norm(crossing) > kWedge;
    for (const Vec3 d : std::span(directions).subspan(is_wedge ? 2 : 0)) {
      const Vec3 own = across(d, place_.normal);
      if (own == Vec3{}) continue;
      const double longer = along_in(own);
      if (longer > kMuchLonger * along) {
        along = longer;
        direction = own;
      }
    }
    if (!(along > kLeastStretch * place_.length)) return {};
    return {SmallNormal(direction), static_cast<float>(along)};
  }

 private:
  double along_in(Vec3 u) const {
    const double aspect = std::min(patch_.stretch.max_aspect, most_aspect_at(patch_.end, u));
    double along = std::min(patch_.stretch.max_length, aspect * place_.length);
    for (const GapPatch* side : {&patch_, place_.other}) {
      const double curvature = curvature_in(side->shape, u);
      if (along * curvature > patch_.stretch.alpha) along = patch_.stretch.alpha / curvature;
      if (along * along * curvature > patch_.stretch.alpha * place_.length)
        along = std::sqrt(patch_.stretch.alpha * place_.length / curvature);
    }
    const double slope = std::abs(dot(opposite_, u) / dot(opposite_, place_.normal));
    return along * slope > kChange * width_ ? kChange * width_ / slope : along;
  }

  const GapPatch& patch_;
  const GapPlace& place_;
  Vec3 opposite_;  // normal of the other side
  double width_;
};

}  // namespace

SampleStretch gap_stretch(const GapPatch& patch, const GapPlace& place) {
  return patch.stretch.max_aspect > 1 ? GapStretch(patch, place).run() : SampleStretch();
}

}  // namespace st
