#include "judge/squared_angle.h"

#include <gtest/gtest.h>

namespace st {
namespace {

TEST(SquaredAngle, is_that_of_the_inverse_tangent_for_any_angle) {
  for (const double angle : {0.0, 1e-9, 1e-3, 0.05, 0.2, 0.3, 0.32, 0.33, 1.0, 1.6, 3.0, kPi}) {
    const Vec3 a{0, 2, 0}, b = 3 * Vec3{std::sin(angle), std::cos(angle), 0};
    EXPECT_NEAR(std::sqrt(squared_angle(a, b)), angle, 1e-7 * angle) << angle;
  }
}

TEST(SquaredAngle, with_no_direction_is_zero) { EXPECT_EQ(squared_angle({0, 0, 0}, {1, 0, 0}), 0); }

}  // namespace
}  // namespace st
