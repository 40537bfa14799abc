// Sides of loops in space.
#include "sizing/space_sides.h"

#include <gtest/gtest.h>

#include "geometry/shape/analytic.h"

namespace st {
namespace {

TEST(SpaceSides, are_on_the_surface_and_know_where_the_face_is) {
  const PlaneSurface plane({{0, 0, 3}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 0, 10, 0, 10);
  const std::vector<SpaceSide> sides = sides_in_space(plane, LoopPolygons({{{1, 1}, {4, 1}, 5}, {{4, 1}, {4, 2}, 6}}));
  ASSERT_EQ(sides.size(), 2U);
  EXPECT_EQ(sides[0].a, (Vec3{1, 1, 3}));
  EXPECT_NEAR(distance(sides[0].end(), {4, 1, 3}), 0, 1e-14);
  EXPECT_EQ(sides[0].inward, (Vec3{0, 1, 0}));
  EXPECT_EQ(sides[1].inward, (Vec3{-1, 0, 0}));
  EXPECT_EQ(sides[1].coedge, 6);
  EXPECT_NEAR(distance(sides[0].nearest_to({9, 2, 3}), {4, 1, 3}), 0, 1e-14);
}

TEST(SpaceSides, are_none_without_a_coedge_or_a_length) {
  const PlaneSurface plane({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 0, 10, 0, 10);
  EXPECT_TRUE(sides_in_space(plane, LoopPolygons({{{1, 1}, {4, 1}, kNone}, {{4, 1}, {4, 1}, 6}})).empty());
}

}  // namespace
}  // namespace st
