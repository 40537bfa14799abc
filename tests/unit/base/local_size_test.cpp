#include "base/local_size.h"

#include <gtest/gtest.h>

namespace st {
namespace {

const Vec3 kX{1, 0, 0}, kY{0, 1, 0};

TEST(LocalSize, asks_for_its_two_lengths_along_and_across_and_for_an_ellipse_between) {
  const LocalSize size{2, 10, kX};
  EXPECT_DOUBLE_EQ(size.in(kX), 10);
  EXPECT_DOUBLE_EQ(size.in(-3 * kX), 10);
  EXPECT_DOUBLE_EQ(size.in(kY), 2);
  EXPECT_DOUBLE_EQ(size.in({0, 0, 5}), 2);
  const double in = size.in({1, 1, 0});  // on x^2 / 100 + y^2 / 4 = 1 where x = y
  EXPECT_NEAR(in * in / 2 * (1.0 / 100 + 1.0 / 4), 1, 1e-12);
  EXPECT_DOUBLE_EQ(size.in({}), 2);
}

TEST(LocalSize, is_the_same_in_all_directions_where_it_has_none) {
  const LocalSize size{3, 3, {}};
  for (const Vec3 d : {kX, kY, Vec3{1, 2, 3}}) EXPECT_DOUBLE_EQ(size.in(d), 3);
  EXPECT_TRUE(size.squeeze() == Vec3{});
}

TEST(Squeeze, makes_edges_of_the_requested_lengths_equal) {
  const LocalSize size{2, 10, normalized(Vec3{1, 2, -1})};
  for (const Vec3 d : {kX, kY, Vec3{1, 2, -1}, Vec3{-3, 1, 0.5}})
    EXPECT_NEAR(norm(squeezed(size.in(d)*normalized(d), size.squeeze())), 2, 1e-12);
}

TEST(Squeeze, has_an_inverse) {
  const Vec3 squeeze = LocalSize{1, 16, normalized(Vec3{1, 1, 3})}.squeeze(), d{0.3, -2, 1.5};
  EXPECT_LE(distance(unsqueezed(squeezed(d, squeeze), squeeze), d), 1e-12);
  EXPECT_TRUE(squeezed(d, {}) == d && unsqueezed(d, {}) == d);
}

}  // namespace
}  // namespace st
