#include "geometry/shape/loop_polygons.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace st {
namespace {

TEST(LoopPolygons, without_sides_everything_is_inside) { EXPECT_TRUE(LoopPolygons().contains({1e9, -1e9})); }

TEST(LoopPolygons, agree_with_the_winding_of_a_star) {
  // a star r(a) = 2 + cos 5a, and the circle r = 0.5 as a hole
  std::vector<LoopSide> sides;
  const int n = 1000;
  const auto star = [](double a) {
    return Vec2{(2 + std::cos(5 * a)) * std::cos(a), (2 + std::cos(5 * a)) * std::sin(a)};
  };
  const auto hole = [](double a) { return Vec2{0.5 * std::cos(a), 0.5 * std::sin(a)}; };
  for (int i = 0; i < n; ++i) {
    const double a = 2 * kPi * i / n, b = 2 * kPi * (i + 1) / n;
    sides.push_back({star(a), star(b)});
    sides.push_back({hole(b), hole(a)});
  }
  const LoopPolygons loops(sides);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-4, 4);
  for (int i = 0; i < 20000; ++i) {
    const Vec2 p{uniform(random), uniform(random)};
    const double r = norm(p), edge = 2 + std::cos(5 * std::atan2(p.y, p.x));
    if (std::abs(r - edge) < 0.01 || std::abs(r - 0.5) < 0.01) continue;
    ASSERT_EQ(loops.contains(p), r > 0.5 && r < edge) << p.x << " " << p.y;
  }
}

TEST(LoopPolygons, know_which_sides_cross) {
  const std::vector<LoopSide> square{{{0, 0}, {1, 0}}, {{1, 0}, {1, 1}}, {{1, 1}, {0, 1}}, {{0, 1}, {0, 0}}};
  EXPECT_TRUE(crossing_sides(square).empty()) << "sides that share ends";
  std::vector<LoopSide> crossed = square;
  crossed.push_back({{0.5, -1}, {0.5, 0.5}});
  EXPECT_EQ(crossing_sides(crossed), (std::vector<std::pair<std::int32_t, std::int32_t>>{{0, 4}}));
  std::vector<LoopSide> bow{{{0, 0}, {1, 1}}, {{1, 1}, {1, 0}}, {{1, 0}, {0, 1}}, {{0, 1}, {0, 0}}};
  EXPECT_EQ(crossing_sides(bow), (std::vector<std::pair<std::int32_t, std::int32_t>>{{0, 2}}));
}

}  // namespace
}  // namespace st
