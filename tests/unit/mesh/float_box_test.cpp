#include "mesh/float_box.h"

#include <gtest/gtest.h>

#include <random>

namespace st {
namespace {

TEST(FloatBox, meets_what_touches_it_in_all_three_axes) {
  const FloatBox box{{0, 0, 0}, {1, 2, 3}};
  for (int axis = 0; axis < 3; ++axis) {
    FloatBox beside = box;
    const float length = box.hi[axis];
    beside.lo[axis] += length, beside.hi[axis] += length;
    EXPECT_TRUE(box.meets(beside)) << axis;
    EXPECT_TRUE(beside.meets(box)) << axis;
    beside.lo[axis] += 0.01f, beside.hi[axis] += 0.01f;
    EXPECT_FALSE(box.meets(beside)) << axis;
    EXPECT_FALSE(beside.meets(box)) << axis;
  }
}

TEST(FloatBox, holds_both_after_adding) {
  FloatBox box{{0, 0, 0}, {1, 2, 3}};
  EXPECT_EQ(box.longest_axis(), 2);
  EXPECT_EQ(box.extent(), 6);
  box.add({{-4, 1, 1}, {0, 5, 2}});
  EXPECT_EQ(box.lo, (std::array<float, 3>{-4, 0, 0}));
  EXPECT_EQ(box.hi, (std::array<float, 3>{1, 5, 3}));
  EXPECT_EQ(box.longest_axis(), 0) << "the first of the longest";
}

TEST(FloatBox, is_compared_and_added_axis_by_axis) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> place(-4, 4), length(0, 3);
  const auto make = [&] {
    FloatBox box{};
    for (int k = 0; k < 3; ++k) {
      box.lo[k] = static_cast<float>(place(random));
      box.hi[k] = box.lo[k] + static_cast<float>(length(random));
    }
    return box;
  };
  int n_meet = 0;
  FloatBox sum = make();
  BoxOverBoxes over(sum);
  for (int i = 0; i < 1000; ++i) {
    const FloatBox a = make(), b = make();
    bool meets = true;
    for (int k = 0; k < 3; ++k) meets = meets && a.lo[k] <= b.hi[k] && b.lo[k] <= a.hi[k];
    n_meet += meets;
    ASSERT_EQ(ComparedBox(a).meets(b), meets) << i;
    if (i > 10) continue;
    sum.add(a);
    over.add(a);
    ASSERT_EQ(over.box().lo, sum.lo) << i;
    ASSERT_EQ(over.box().hi, sum.hi) << i;
  }
  EXPECT_GT(n_meet, 50);
  EXPECT_LT(n_meet, 950);
}

}  // namespace
}  // namespace st
