#include "base/eigen.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace st {
namespace {

TEST(Eigen, vectors_come_back_as_they_went) {
  EXPECT_EQ(to_vec2(to_eigen(Vec2{1, -2})), (Vec2{1, -2}));
  EXPECT_EQ(to_vec3(to_eigen(Vec3{1, -2, 3})), (Vec3{1, -2, 3}));
}

TEST(Solve, finds_what_the_matrix_was_multiplied_with) {
  const Eigen::Matrix2d plane = symmetric(3, -1, 2);
  const Eigen::Vector2d x2(0.5, -4);
  ASSERT_TRUE(solve<2>(plane, plane * x2, 0));
  EXPECT_LE((*solve<2>(plane, plane * x2, 0) - x2).norm(), 1e-15 * x2.norm());
  Eigen::Matrix3d space;
  space << 4, 1, -2, 0, 3, 0.5, 1, -1, 5;
  const Eigen::Vector3d x3(1, 2, -3);
  ASSERT_TRUE(solve<3>(space, space * x3, 0));
  EXPECT_LE((*solve<3>(space, space * x3, 0) - x3).norm(), 1e-14 * x3.norm());
}

// Meshes of models with knife edges hang on the last bit: the inverse times the right side would round once more.
TEST(Solve, rounds_in_the_plane_as_cramers_rule_does) {
  for (int i = 1; i <= 100; ++i) {
    const double a = 3 + 1.0 / i, b = std::sin(i), c = 2 + std::cos(i), p = 0.7 * i, q = 1 / (i + 0.3);
    const auto x = solve<2>(symmetric(a, b, c), {p, q}, 0);
    ASSERT_TRUE(x);
    EXPECT_EQ(x->x(), (c * p - b * q) / (a * c - b * b));
    EXPECT_EQ(x->y(), (a * q - b * p) / (a * c - b * b));
  }
}

TEST(Solve, has_no_answer_below_the_least_determinant) {
  const Eigen::Vector2d b(1, 1);
  EXPECT_FALSE(solve(symmetric(1, 1, 1), b, 0));
  EXPECT_TRUE(solve(symmetric(1, 0, 1e-6), b, 1e-7));
  EXPECT_FALSE(solve(symmetric(1, 0, 1e-6), b, 1e-5));
  EXPECT_FALSE(solve<3>(Eigen::Matrix3d::Zero(), Eigen::Vector3d::Ones(), 0));
}

TEST(Solve, has_no_answer_where_the_determinant_is_negative_or_not_a_number) {
  const Eigen::Vector2d b(1, 1);
  EXPECT_FALSE(solve(symmetric(1, 2, 1), b, 0));
  EXPECT_FALSE(solve(symmetric(std::numeric_limits<double>::quiet_NaN(), 0, 1), b, 0));
  EXPECT_FALSE(solve(symmetric(1, 0, 1), b, std::numeric_limits<double>::quiet_NaN()));
}

// Aligned types would make std::vector members and structs that hold them depend on the instruction set of each file.
TEST(Eigen, types_are_as_plain_as_their_doubles) {
  EXPECT_EQ(alignof(Eigen::Vector2d), alignof(double));
  EXPECT_EQ(alignof(Eigen::Matrix2d), alignof(double));
  EXPECT_EQ(sizeof(Eigen::Matrix3d), 9 * sizeof(double));
}

}  // namespace
}  // namespace st
