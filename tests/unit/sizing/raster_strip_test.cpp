// Sizes that the width of a strip asks for.
#include "sizing/raster_strip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/tapered_strip.h"

namespace st {
namespace {

SamplingLimits limits(double min_length, double max_length) {
  SamplingLimits l;
  l.min_length = min_length;
  l.max_length = max_length;
  return l;
}

TEST(RasterStrip, asks_for_its_width_within_the_limits_and_for_nothing_where_it_is_too_narrow) {
  const Strip strip = test::tapered_strip();
  ASSERT_NE(strip.face, kNone);
  std::vector<RasterBox> boxes;
  raster_strip(strip, limits(0.5, 2), 7, boxes);
  ASSERT_FALSE(boxes.empty());
  for (const RasterBox& b : boxes) {
    const double width = 0.02 + 0.98 * b.center.x / 20;
    EXPECT_NEAR(b.length, 1.25 * width, 0.02);
    EXPECT_GT(width, 0.5 / 6.5);
    EXPECT_LT(b.length, 2);
    EXPECT_EQ(b.cause, 7);
  }
  std::vector<double> x;
  for (const RasterBox& b : boxes) x.push_back(b.center.x);
  std::sort(x.begin(), x.end());
  for (std::size_t i = 1; i < x.size(); ++i)
    EXPECT_LT(x[i] - x[i - 1], 2) << "boxes follow each other at about their lengths";
}

TEST(RasterStrip, asks_for_nothing_where_its_edges_cross_and_are_one) {
  Strip strip = test::tapered_strip();
  strip.exact = 0.2;
  std::vector<RasterBox> boxes;
  raster_strip(strip, limits(0.05, 2), 7, boxes);
  ASSERT_FALSE(boxes.empty());
  for (const RasterBox& b : boxes) EXPECT_GT(b.length, 1.25 * 0.39);
}

TEST(RasterStrip, follows_edges_of_many_turns) {
  const Model model = test::make_model("helical_ribbon");
  const std::vector<Strip> strips = find_strips(model);
  ASSERT_EQ(strips.size(), 3u);
  for (const Strip& strip : strips) {
    for (const Strip::Station& s : strip.stations) {
      EXPECT_GT(s.width(), 0.29);
      EXPECT_LT(s.width(), 0.43);
    }
    std::vector<RasterBox> boxes;
    raster_strip(strip, limits(0.2, 10), 0, boxes);
    EXPECT_GT(static_cast<double>(boxes.size()), strip.length / (1.25 * 0.43) - 2);
    for (const RasterBox& b : boxes) {
      const double r = std::hypot(b.center.x, b.center.y);
      EXPECT_TRUE(r > 9.9 && r < 10.31) << r;
    }
  }
}

TEST(RasterStrip, asks_for_its_own_width_below_the_smallest_length_down_to_a_fifth) {
  const Strip strip = test::tapered_strip();
  ASSERT_NE(strip.face, kNone);
  std::vector<RasterBox> boxes;
  raster_strip(strip, limits(2, 10), 0, boxes);
  ASSERT_FALSE(boxes.empty());
  float least = 10;
  for (const RasterBox& b : boxes) least = std::min(least, b.length);
  EXPECT_NEAR(least, 1.25 * 0.17 * 2, 0.03);
}

}  // namespace
}  // namespace st
