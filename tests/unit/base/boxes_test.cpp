// What is near boxes.
#include "base/boxes.h"

#include <gtest/gtest.h>

namespace st {
namespace {

TEST(Boxes, meet_what_touches_them_in_all_three_axes) {
  const Box3 box{{0, 0, 0}, {1, 2, 3}};
  for (const auto axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
    Box3 beside = box;
    beside.lo.*axis = box.hi.*axis;
    beside.hi.*axis += 1;
    EXPECT_TRUE(meet(box, beside));
    EXPECT_TRUE(meet(beside, box));
    beside.lo.*axis += 0.5;
    EXPECT_FALSE(meet(box, beside));
    EXPECT_FALSE(meet(beside, box));
    EXPECT_TRUE(meet(box, beside, 0.5));
    EXPECT_TRUE(meet(beside, box, 0.5));
  }
}

TEST(Boxes, meet_nothing_where_they_are_empty) {
  EXPECT_FALSE(meet(Box3{}, Box3{{0, 0, 0}, {1, 1, 1}}));
  EXPECT_FALSE(meet(Box3{}, Box3{}, 1));
}

TEST(Boxes, contain_what_is_nowhere_outside_them) {
  const Box3 box{{0, 0, 0}, {1, 2, 3}};
  EXPECT_TRUE(contains(box, box));
  EXPECT_TRUE(contains(box, Vec3{1, 2, 0}));
  for (const auto axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
    Box3 larger = box;
    larger.hi.*axis += 0.5;
    EXPECT_TRUE(contains(larger, box));
    EXPECT_FALSE(contains(box, larger));
    EXPECT_TRUE(contains(box, larger, 0.5));
    Vec3 below = box.lo;
    below.*axis -= 0.5;
    EXPECT_FALSE(contains(box, below));
    EXPECT_TRUE(contains(box, below, 0.5));
  }
}

TEST(Boxes, have_a_box_in_common) {
  const Box3 common = common_box({{0, 0, 0}, {2, 3, 4}}, {{1, -1, 2}, {5, 1, 3}});
  EXPECT_EQ(common.lo, (Vec3{1, 0, 2}));
  EXPECT_EQ(common.hi, (Vec3{2, 1, 3}));
  EXPECT_TRUE(common_box({{0, 0, 0}, {1, 1, 1}}, {{2, 0, 0}, {3, 1, 1}}).is_empty());
}

TEST(Boxes, are_as_far_from_a_point_as_their_nearest_point) {
  const Box3 box{{0, 0, 0}, {1, 2, 3}};
  EXPECT_EQ(distance2({0.5, 1, 2}, box), 0);
  EXPECT_EQ(distance2({-3, 1, 7}, box), 25);
}

}  // namespace
}  // namespace st
