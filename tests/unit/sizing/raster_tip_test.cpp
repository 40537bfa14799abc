// What is not asked for where a face runs to a point.
#include "sizing/raster_tip.h"

#include <gtest/gtest.h>

#include <initializer_list>

#include "geometry/shape/analytic.h"

namespace st {
namespace {

/// A loop of straight edges, each in 20 sides, on the plane z = 0.
std::vector<SpaceSide> sides_of(std::initializer_list<Vec2> corners) {
  const PlaneSurface plane({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, -20, 20, -20, 20);
  constexpr int kSidesPerEdge = 20;
  std::vector<LoopSide> sides;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 a = *(corners.begin() + i), b = *(corners.begin() + (i + 1) % corners.size());
    for (int k = 0; k < kSidesPerEdge; ++k)
      sides.push_back({a + (1.0 * k / kSidesPerEdge) * (b - a), a + ((k + 1.0) / kSidesPerEdge) * (b - a),
                       static_cast<CoedgeId>(i)});
  }
  return sides_in_space(plane, LoopPolygons(sides));
}

/// Whether a box of this length at a place stays.
bool stays(const std::vector<SpaceSide>& sides, Vec3 x, float length, std::size_t first = 0) {
  SamplingLimits limits;
  limits.min_length = 0.05;
  limits.max_length = 2;
  std::vector<RasterBox> boxes{{x, 0.1F, length}};
  drop_tips(sides, limits, first, boxes);
  return !boxes.empty();
}

/// One wide at x = 10, a point at x = 0.
std::vector<SpaceSide> wedge() { return sides_of({{0, 0}, {10, 0}, {10, 1}}); }

TEST(RasterTip, takes_lengths_that_are_long_for_the_width) {
  EXPECT_FALSE(stays(wedge(), {1, 0.05, 0}, 0.5F)) << "0.1 wide";
  EXPECT_TRUE(stays(wedge(), {2.5, 0.1, 0}, 0.5F)) << "0.25 wide";
  EXPECT_TRUE(stays(wedge(), {1, 0.05, 0}, 0.2F));
  EXPECT_FALSE(stays(wedge(), {0.3, 0.01, 0}, 0.1F)) << "between two ends of sides";
}

TEST(RasterTip, leaves_what_others_asked_for_and_the_largest_length) {
  EXPECT_TRUE(stays(wedge(), {1, 0.05, 0}, 0.5F, 1));
  EXPECT_TRUE(stays(wedge(), {1, 0.05, 0}, 2.0F)) << "a rule may ask for it";
}

TEST(RasterTip, is_none_at_a_corner_a_notch_and_a_slit) {
  EXPECT_TRUE(stays(sides_of({{0, 0}, {10, 0}, {10, 5}}), {0.1, 0.01, 0}, 0.5F));
  const std::vector<SpaceSide> notch = sides_of({{10, -5}, {10, 0}, {0, 0.5}, {10, 1}, {10, 6}, {-10, 6}, {-10, -5}});
  EXPECT_TRUE(stays(notch, {0.5, 0.5, 0}, 0.5F));
  EXPECT_TRUE(stays(sides_of({{10, 0}, {10, 5}, {-10, 5}, {-10, 0}, {0, 0}, {-10, 0}, {-10, -5}, {10, -5}}),
                    {-0.5, 0, 0}, 0.5F));
}

}  // namespace
}  // namespace st
