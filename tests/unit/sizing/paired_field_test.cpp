#include "sizing/paired_field.h"

#include <gtest/gtest.h>

namespace st {
namespace {

/// Smaller at low x; stretched along y.
class Field : public UniformField {
 public:
  Field() : UniformField(0.1) {}
  LocalSize local(Vec3 x, int&) const override { return {0.1 + x.x, 1 + x.x, {0, 1, 0}}; }
  bool is_stretched() const override { return true; }
};

Box3 box(Vec3 lo, Vec3 hi) {
  Box3 b;
  b.add(lo);
  b.add(hi);
  return b;
}

TEST(PairedField, asks_for_the_smaller_length_on_both_sides_and_nowhere_else) {
  const Field base;
  const PairedField field(base, {{box({0, 0, 0}, {0, 1, 1}), box({1, 0, 0}, {1, 1, 1}), {.translation = {1, 0, 0}}}},
                          1e-6);
  EXPECT_DOUBLE_EQ(field.SizeField::size({0, 0.5, 0.5}), 0.1);
  EXPECT_DOUBLE_EQ(field.SizeField::size({1, 0.5, 0.5}), 0.1);
  EXPECT_DOUBLE_EQ(field.SizeField::size({0.9, 0.5, 0.5}), 1.0);
}

TEST(PairedField, turns_directions_back) {
  const Field base;
  const Similarity turn = rotation_about({0, 0, 1}, kPi / 2);  // x to y
  const PairedField field(base, {{box({0, 0, 0}, {2, 0, 1}), box({0, 0, 0}, {0, 2, 1}), turn}}, 1e-6);
  int hint = 0;
  const LocalSize at = field.local({1, 0, 0.5}, hint);
  EXPECT_NEAR(at.length, 0.1, 1e-12) << "as its image at x = 0";
  EXPECT_NEAR(std::abs(at.direction.x), 1, 1e-12) << "y there is x here";
}

TEST(PairedField, sees_all_images_of_a_corner) {
  const Field base;
  const PairedField field(base,
                          {{box({0, 0, 0}, {0, 1, 1}), box({1, 0, 0}, {1, 1, 1}), {.translation = {1, 0, 0}}},
                           {box({0, 0, 0}, {1, 0, 1}), box({0, 1, 0}, {1, 1, 1}), {.translation = {0, 1, 0}}}},
                          1e-6);
  EXPECT_DOUBLE_EQ(field.SizeField::size({1, 1, 0.5}), 0.1);
}

}  // namespace
}  // namespace st
