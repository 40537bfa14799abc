#include "geometry/import/plane_facets.h"

#include <gtest/gtest.h>

namespace st {
namespace {

/// Polygons one after the other.
struct Outlines {
  std::vector<Vec2> x;
  std::vector<std::pair<std::int32_t, std::int32_t>> sides;

  void add(const std::vector<Vec2>& polygon) {
    const auto first = static_cast<std::int32_t>(x.size()), n = static_cast<std::int32_t>(polygon.size());
    x.insert(x.end(), polygon.begin(), polygon.end());
    for (std::int32_t i = 0; i < n; ++i) sides.emplace_back(first + (i + 1) % n, first + i);
  }
  void add_square(Vec2 middle, double half) {
    add({middle + Vec2{-half, -half}, middle + Vec2{half, -half}, middle + Vec2{half, half},
         middle + Vec2{-half, half}});
  }
};

double area_of(const Outlines& o, const std::vector<Corners>& triangles) {
  double area = 0;
  for (const Corners& c : triangles) {
    const double own = 0.5 * cross(o.x[c[1]] - o.x[c[0]], o.x[c[2]] - o.x[c[0]]);
    EXPECT_GT(own, 0);
    area += own;
  }
  return area;
}

TEST(PlaneFacets, fill_every_second_region) {
  Outlines o;
  o.add_square({0, 0}, 10);
  o.add_square({1, 1}, 3);
  o.add_square({1, 1}, 1);
  o.add_square({-6, -6}, 1);
  const auto triangles = facets_between(o.x, o.sides);
  ASSERT_TRUE(triangles.has_value());
  EXPECT_NEAR(area_of(o, *triangles), 400 - 36 + 4 - 4, 1e-9);
}

TEST(PlaneFacets, have_an_area_beside_points_in_a_line) {
  Outlines o;
  std::vector<Vec2> fine;
  for (int i = 0; i < 200; ++i) fine.push_back({0.01 * i - 1, 0});
  for (int i = 0; i < 200; ++i) fine.push_back({1 - 0.01 * i, 1e-4 * (i > 0)});
  o.add_square({0, 0}, 10);
  o.add(fine);
  const auto triangles = facets_between(o.x, o.sides);
  ASSERT_TRUE(triangles.has_value());
  EXPECT_NEAR(area_of(o, *triangles), 400 - 2e-4, 1e-5);
}

TEST(PlaneFacets, need_outlines_that_close_and_do_not_cross) {
  Outlines open, crossing;
  open.add_square({0, 0}, 1);
  open.sides.pop_back();
  EXPECT_FALSE(facets_between(open.x, open.sides).has_value());
  crossing.add_square({0, 0}, 1);
  crossing.add_square({1, 1}, 0.9);
  EXPECT_FALSE(facets_between(crossing.x, crossing.sides).has_value());
}

}  // namespace
}  // namespace st
