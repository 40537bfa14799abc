// A line through places on a curved nose.
#pragma once

#include <cstddef>
#include <span>

#include "base/vec.h"

namespace st {

/// Between two places of a line, as smooth as it is there: straight lines between noses leave a curved one by more than
/// a length. Straight beside kinks.
class SmoothPiece {
 public:
  SmoothPiece(std::span<const Vec3> x, std::size_t i) : begin_(x[i]), way_(x[i + 1] - x[i]) {
    const Vec3 along = normalized(way_);
    const auto direction = [&](Vec3 beside) {
      const Vec3 own = normalized(beside);
      if (dot(own, along) > kStraight) return along;
      has_kink_ |= dot(own, along) <= kKink;
      return dot(own, along) > kKink ? normalized(own * norm(way_) + along * norm(beside)) : along;
    };
    const Vec3 from = i > 0 ? direction(x[i] - x[i - 1]) : along;
    const Vec3 to = i + 2 < x.size() ? direction(x[i + 2] - x[i + 1]) : along;
    bend_begin_ = norm(way_) * (from - along);
    bend_end_ = norm(way_) * (to - along);
  }
  /// At one of its ends.
  bool has_kink() const { return has_kink_; }

  Vec3 at(double share) const {
    const double rest = 1 - share;
    return begin_ + share * way_ + share * rest * (rest * bend_begin_ - share * bend_end_);
  }

 private:
  static constexpr double kKink = 0.966;         // cosine, 15 degrees, between two pieces
  static constexpr double kStraight = 1 - 1e-9;  // likewise: rounding
  Vec3 begin_, way_, bend_begin_, bend_end_;
  bool has_kink_ = false;
};

}  // namespace st
