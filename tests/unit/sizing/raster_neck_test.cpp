// Sizes that narrow parts of faces ask for.
#include "sizing/raster_neck.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/shape/analytic.h"

namespace st {
namespace {

const Frame kNeckFrame{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

SamplingLimits neck_limits(double min_length, double max_length) {
  SamplingLimits limits;
  limits.min_length = min_length;
  limits.max_length = max_length;
  return limits;
}

/// A loop about `corners`, in sides of at most 0.5 as a tracer makes them; each straight piece is a coedge.
void add_loop(const std::vector<Vec2>& corners, std::vector<LoopSide>& sides) {
  CoedgeId coedge = sides.empty() ? 0 : sides.back().coedge + 1;
  for (std::size_t i = 0; i < corners.size(); ++i, ++coedge) {
    const Vec2 a = corners[i], b = corners[(i + 1) % corners.size()];
    const int n = static_cast<int>(std::ceil(std::hypot(b.x - a.x, b.y - a.y) / 0.5));
    for (int k = 0; k < n; ++k)
      sides.push_back({a + (1.0 * k / n) * (b - a), a + (1.0 * (k + 1) / n) * (b - a), coedge});
  }
}

/// A square of 10 with a window, clockwise.
LoopPolygons frame_with_window(const std::vector<Vec2>& window) {
  std::vector<LoopSide> sides;
  add_loop({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, sides);
  add_loop(window, sides);
  return LoopPolygons(sides);
}

std::vector<RasterBox> boxes_of(const LoopPolygons& loops, const SamplingLimits& limits, bool counts = true) {
  const PlaneSurface plane(kNeckFrame, -1, 11, -1, 11);
  std::vector<RasterBox> boxes;
  raster_necks(
      sides_in_space(plane, loops), limits, 7, [&](CoedgeId, CoedgeId) { return counts; }, boxes);
  return boxes;
}

TEST(RasterNecks, ask_for_twice_their_width) {
  const std::vector<RasterBox> boxes =
      boxes_of(frame_with_window({{3, 0.1}, {3, 4}, {7, 4}, {7, 0.1}}), neck_limits(0.05, 2));
  ASSERT_FALSE(boxes.empty());
  std::vector<double> x;
  for (const RasterBox& b : boxes) {
    EXPECT_NEAR(b.length, 0.2, 1e-6);
    EXPECT_NEAR(b.center.y, 0.05, 1e-9);
    EXPECT_EQ(b.cause, 7);
    x.push_back(b.center.x);
  }
  std::sort(x.begin(), x.end());
  EXPECT_LT(x.front(), 3.2);
  EXPECT_GT(x.back(), 6.8);
  for (std::size_t i = 1; i < x.size(); ++i) EXPECT_LT(x[i] - x[i - 1], 0.21);
}

TEST(RasterNecks, are_none_across_what_is_no_part_of_the_face) {
  // the window's own width is 0.1
  EXPECT_TRUE(boxes_of(frame_with_window({{3, 4}, {3, 4.1}, {7, 4.1}, {7, 4}}), neck_limits(0.05, 2)).empty());
}

TEST(RasterNecks, ask_for_nothing_where_they_are_wide_or_too_narrow_or_do_not_count) {
  EXPECT_TRUE(boxes_of(frame_with_window({{3, 0.8}, {3, 4}, {7, 4}, {7, 0.8}}), neck_limits(0.05, 2)).empty());
  const LoopPolygons narrow = frame_with_window({{3, 0.1}, {3, 4}, {7, 4}, {7, 0.1}});
  EXPECT_TRUE(boxes_of(narrow, neck_limits(0.6, 2)).empty());
  EXPECT_FALSE(boxes_of(narrow, neck_limits(0.5, 2)).empty()) << "below the smallest length, as strips do";
  EXPECT_TRUE(boxes_of(narrow, neck_limits(0.05, 2), false).empty());
}

TEST(RasterNecks, keep_to_the_smallest_length_where_they_taper) {
  const std::vector<RasterBox> boxes =
      boxes_of(frame_with_window({{3, 0.2}, {3, 4}, {7, 4}, {7, 0.6}}), neck_limits(0.5, 2));
  ASSERT_FALSE(boxes.empty());
  for (const RasterBox& b : boxes) {
    EXPECT_GE(b.length, 0.5f);
    EXPECT_NEAR(b.length, std::max(0.5, 2 * (0.2 + 0.4 * (b.center.x - 3) / 4)), 0.02);
  }
}

TEST(RasterNecks, ask_for_nothing_where_they_widen_from_a_place_that_is_too_narrow) {
  // from x = 4.5 on it widens to 0.5
  const auto beside = [](double width) {
    std::vector<RasterBox> boxes =
        boxes_of(frame_with_window({{3, width}, {3, 4}, {7, 4}, {7, 0.5}, {4.5, width}}), neck_limits(0.05, 2));
    std::erase_if(boxes, [](const RasterBox& b) { return b.center.x < 4.6; });
    return boxes;
  };
  EXPECT_TRUE(beside(0.004).empty());
  EXPECT_FALSE(beside(0.02).empty());
}

}  // namespace
}  // namespace st
