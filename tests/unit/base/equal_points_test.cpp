#include "base/equal_points.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

namespace st {
namespace {

using Corners = std::array<std::int32_t, 3>;

TEST(EqualPoints, at_one_place_are_one_node) {
  const std::vector<Vec3> x = {{0, 0, 0},       {1, 0, 0}, {0, 1, 0},      {1, 0, 0},
                               {-0.0, 1, -0.0}, {1, 1, 0}, {1, 1e-300, 0}, {1, 0, 0}};
  std::vector<Corners> corners = {{0, 1, 2}, {3, 5, 4}, {6, 5, 7}};
  join_equal_points(x, corners);
  EXPECT_EQ(corners, (std::vector<Corners>{{0, 1, 2}, {1, 5, 2}, {6, 5, 1}}));
}

TEST(EqualPoints, are_found_among_many) {
  std::vector<Vec3> x;
  std::vector<Corners> corners;
  constexpr std::int32_t kSide = 60;  // more than are sorted by comparison
  for (int copy = 0; copy < 2; ++copy)
    for (std::int32_t i = 0; i < kSide * kSide; ++i) x.push_back({1.0 / (1 + i % kSide), 0.1 * (i / kSide), 0.5});
  for (std::int32_t i = 0; i < kSide * kSide; ++i) corners.push_back({i, kSide * kSide + i, i});
  join_equal_points(x, corners);
  for (std::int32_t i = 0; i < kSide * kSide; ++i) EXPECT_EQ(corners[i], (Corners{i, i, i}));
}

}  // namespace
}  // namespace st
