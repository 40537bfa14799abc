// The rectangle on which a sample asks for its length.
#include "sizing/sample_reach.h"

#include <gtest/gtest.h>

namespace st {
namespace {

Vec3 side(const float (&s)[3]) { return {s[0], s[1], s[2]}; }

TEST(SampleReach, is_the_rectangle_itself) {
  const SampleReach r = reach_of({0, 0, 1}, {3, 4, 0});
  EXPECT_EQ(side(r.u), (Vec3{3, 4, 0})) << "the longer side first";
  EXPECT_EQ(side(r.v), (Vec3{0, 0, 1}));
}

TEST(SampleReach, holds_a_parallelogram) {
  const Vec3 a{2, 0, 0}, b{0.5, 1, 0};
  const SampleReach r = reach_of(a, b);
  EXPECT_NEAR(dot(side(r.u), side(r.v)), 0, 1e-7);
  for (const Vec3 corner : {a + b, a - b, b - a, Vec3{} - a - b}) {
    EXPECT_LE(std::abs(dot(corner, side(r.u))), 1.000001 * norm2(side(r.u)));
    EXPECT_LE(std::abs(dot(corner, side(r.v))), 1.000001 * norm2(side(r.v)));
  }
}

TEST(SampleReach, of_a_line_or_a_place_has_no_width) {
  EXPECT_EQ(side(reach_of({0, 2, 0}).u), (Vec3{0, 2, 0}));
  EXPECT_EQ(side(reach_of({0, 2, 0}).v), Vec3{});
  EXPECT_EQ(reach_of({}), SampleReach{});
}

}  // namespace
}  // namespace st
