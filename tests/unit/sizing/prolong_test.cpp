#include "sizing/prolong.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/threads.h"
#include "unit/sizing/cases.h"

namespace st {
namespace {

constexpr double kFrontSlope = 0.2;
constexpr double kFrontMaxLength = 0.06;

struct Case {
  RasterOctree raster;
  std::vector<float> lengths;
  OctreeView view() const { return raster.shape.view(); }
};

Case make_case(const std::vector<RasterBox>& boxes, double max_length = kFrontMaxLength) {
  Case c{build_octree(test::kUnitBox, boxes), {}};
  c.lengths = prolong(Neighbours(c.view()), c.raster.stored_length, {kFrontSlope, max_length});
  return c;
}

TEST(Prolong, never_exceeds_stored_lengths_nor_the_largest_length) {
  const Case c = make_case(test::sphere_boxes(2000));
  for (std::size_t i = 0; i < c.lengths.size(); ++i)
    ASSERT_LE(c.lengths[i], std::min(c.raster.stored_length[i], static_cast<float>(kFrontMaxLength)));
}

TEST(Prolong, is_the_largest_field_that_respects_the_slope) {
  // between neighbours: never more than the slope; and each cell is either at its own bound, or exactly at a
  // neighbour's limit
  const Case c = make_case(test::sphere_boxes(2000));
  const Neighbours neighbours(c.view());
  int n_limited = 0;
  for (std::int32_t a = 0; a < c.view().n_leaves(); ++a) {
    const std::size_t i = static_cast<std::size_t>(a);
    float limit = std::min(c.raster.stored_length[i], static_cast<float>(kFrontMaxLength));
    const float own = limit;
    neighbours.for_each_across_face(a, [&](std::int32_t b, const CellStep&) {
      const double d = distance(c.view().leaf_center(a), c.view().leaf_center(b));
      limit = std::min(limit, static_cast<float>(c.lengths[b] + kFrontSlope * d));
    });
    ASSERT_NEAR(c.lengths[i], limit, 1e-6F * limit);
    n_limited += c.lengths[i] < own;
  }
  EXPECT_GT(n_limited, c.view().n_leaves() / 10);
}

TEST(Prolong, is_larger_than_straight_ways_by_the_detours_alone) {
  const std::vector<RasterBox> spot{{{0.5, 0.5, 0.5}, 0.01F, 0.01F, 1}};
  const Case c = make_case(spot, 10);
  int n_larger = 0;
  for (std::int32_t leaf = 0; leaf < c.view().n_leaves(); ++leaf) {
    const double straight = 0.01 + kFrontSlope * distance(c.view().leaf_center(leaf), {0.5, 0.5, 0.5}),
                 within = kFrontSlope * 0.02;  // of the cells that the spot lies in
    ASSERT_GE(c.lengths[leaf], straight - within);
    ASSERT_LE(c.lengths[leaf], std::sqrt(3.0) * straight + within);
    n_larger += c.lengths[leaf] > 1.1 * straight;
  }
  EXPECT_GT(n_larger, 0);
}

TEST(Prolong, gives_the_same_bits_on_any_number_of_threads) {
  const std::vector<RasterBox> boxes = test::sphere_boxes(20'000);  // more cells than one share of a bucket has
  const std::vector<float> one = make_case(boxes).lengths;
  for (int run = 0; run < 20; ++run) {
    set_thread_count(2 + run % 7);
    const std::vector<float> more = make_case(boxes).lengths;
    set_thread_count(1);
    ASSERT_EQ(one, more);
  }
}

TEST(Prolong, does_nothing_without_stored_lengths) { EXPECT_EQ(make_case({}, 0.5).lengths, std::vector<float>{0.5F}); }

}  // namespace
}  // namespace st
