#include "mesh/float_box.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace st
