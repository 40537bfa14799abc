#include "sizing/line_stretch.h"

#include <gtest/gtest.h>

#include <cmath>

namespace st {
namespace {

const StretchLimits kLimits{16, 3, radians(10)};

Vec3 on_line(double share) { return {10 * share, 0, 0}; }

TEST(StretchAlong, is_as_long_as_the_aspect_or_the_largest_length_allows_on_a_line) {
  for (const double share : {0.0, 0.4, 1.0}) {
    const SampleStretch s = stretch_along(on_line, share, 10, 0.1, kLimits);
    EXPECT_FLOAT_EQ(s.along, 1.6F);
    EXPECT_LE(distance(Vec3(s.direction), {1, 0, 0}), 1e-12);
  }
  EXPECT_FLOAT_EQ(stretch_along(on_line, 0.5, 10, 0.5, kLimits).along, 3);
}

TEST(StretchAlong, is_none_where_it_may_not_be_longer_than_across) {
  EXPECT_EQ(stretch_along(on_line, 0.5, 10, 0.1, {1, 3, radians(10)}).along, 0);
  EXPECT_EQ(stretch_along(on_line, 0.5, 10, 2.9, kLimits).along, 0);
  EXPECT_EQ(stretch_along([](double) { return Vec3{1, 2, 3}; }, 0.5, 0, 0.1, kLimits).along, 0) << "a point";
}

TEST(StretchAlong, turns_no_further_than_alpha_and_stays_near_its_chord) {
  const double radius = 5;
  const auto on_circle = [&](double share) {
    return Vec3{radius * std::cos(2 * kPi * share), radius * std::sin(2 * kPi * share), 0};
  };
  for (const double across : {0.01, 0.05, 0.2, 0.6}) {
    const SampleStretch s = stretch_along(on_circle, 0.3, 2 * kPi * radius, across, {100, 100, radians(10)});
    if (s.along == 0) continue;
    EXPECT_LE(s.along / radius, 1.01 * radians(10));
    EXPECT_LE(s.along * s.along / (8 * radius), 0.16 * across) << across;
    EXPECT_GT(s.along, 0.6 * std::min(radius * radians(10), std::sqrt(8 * 0.15 * across * radius))) << across;
  }
}

TEST(StretchAlong, ends_before_a_corner) {
  const auto bent = [](double share) { return share < 0.5 ? Vec3{10 * share, 0, 0} : Vec3{5, 10 * (share - 0.5), 0}; };
  EXPECT_FLOAT_EQ(stretch_along(bent, 0.2, 10, 0.1, kLimits).along, 1.6F);
  EXPECT_EQ(stretch_along(bent, 0.5, 10, 0.1, kLimits).along, 0);
  const SampleStretch near = stretch_along(bent, 0.45, 10, 0.1, kLimits);
  EXPECT_LE(near.along, 0.56F);
  EXPECT_GT(near.along, 0.3F);
}

}  // namespace
}  // namespace st
