#include "meshing/refined_field.h"

#include <gtest/gtest.h>

namespace st {
namespace {

TEST(RefinedField, is_the_length_of_the_point_there_and_grows_with_the_distance) {
  const UniformField base(10);
  const RefinedField f(base, {{{0, 0, 0}, 1}, {{100, 0, 0}, 2}});
  EXPECT_DOUBLE_EQ(f.size({0, 0, 0}), 1);
  EXPECT_DOUBLE_EQ(f.size({10, 0, 0}), 1 + 10 * kRefinementSlope);
  EXPECT_DOUBLE_EQ(f.size({100, 0, 0}), 2);
  EXPECT_DOUBLE_EQ(f.size({50, 0, 0}), 10);
  EXPECT_DOUBLE_EQ(f.min_size(), 1);
  EXPECT_DOUBLE_EQ(f.slope(), kRefinementSlope);
}

TEST(RefinedField, is_never_coarser_than_its_base) {
  const UniformField base(0.5);
  const RefinedField f(base, {{{0, 0, 0}, 1}});
  EXPECT_DOUBLE_EQ(f.size({0, 0, 0}), 0.5);
  EXPECT_DOUBLE_EQ(f.min_size(), 0.5);
  EXPECT_DOUBLE_EQ(RefinedField(base, {}).size({1, 2, 3}), 0.5);
}

}  // namespace
}  // namespace st
