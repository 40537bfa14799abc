#include "base/vec.h"

#include <gtest/gtest.h>

namespace st {
namespace {

TEST(Vec, cross_is_perpendicular_and_right_handed) {
  EXPECT_EQ(cross(Vec3{1, 0, 0}, Vec3{0, 1, 0}), (Vec3{0, 0, 1}));
  const Vec3 a{1, 2, 3}, b{-2, 0.5, 4};
  EXPECT_EQ(dot(cross(a, b), a), 0);
  EXPECT_EQ(dot(cross(a, b), b), 0);
}

TEST(Vec, angle_is_accurate_where_the_cosine_is_not) {
  EXPECT_NEAR(angle_between({1, 0, 0}, {1, 1e-9, 0}), 1e-9, 1e-18);
  EXPECT_DOUBLE_EQ(angle_between({1, 0, 0}, {-2, 0, 0}), kPi);
  EXPECT_EQ(angle_between({1, 0, 0}, {0, 0, 0}), 0);
}

TEST(Vec, normalized_zero_is_zero) { EXPECT_EQ(normalized(Vec3{}), Vec3{}); }

TEST(Vec, degrees_and_radians_are_inverse) { EXPECT_DOUBLE_EQ(degrees(radians(37.5)), 37.5); }

TEST(Box3, starts_empty_and_grows) {
  Box3 box;
  EXPECT_TRUE(box.is_empty());
  EXPECT_EQ(box.diagonal(), 0);
  box.add(Box3{});
  EXPECT_TRUE(box.is_empty());
  box.add(Vec3{1, 2, 3});
  EXPECT_FALSE(box.is_empty());
  EXPECT_EQ(box.diagonal(), 0);
  box.add(Vec3{4, 6, 3});
  EXPECT_EQ(box.diagonal(), 5);
  EXPECT_EQ(box.center(), (Vec3{2.5, 4, 3}));
}

}  // namespace
}  // namespace st
