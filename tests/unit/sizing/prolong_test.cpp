#include "sizing/prolong.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sizing/neighbours.h"
#include "unit/sizing/cases.h"

namespace st {
namespace {

constexpr double kFrontSlope = 0.2;
constexpr double kFrontMaxLength = 0.06;

struct Case {
  RasterOctree raster;
  ProlongedLengths cells;
  OctreeView view() const { return raster.shape.view(); }
};

Case make_case(int n_boxes, double slope = kFrontSlope) {
  Case c{build_octree(test::kUnitBox, test::sphere_boxes(n_boxes)), {}};
  c.cells = prolong(Neighbours(c.view()), c.raster.stored_length, c.raster.stored_cause, {slope, kFrontMaxLength});
  return c;
}

TEST(Prolong, never_exceeds_stored_lengths_nor_the_largest_length) {
  const Case c = make_case(2000);
  for (std::size_t i = 0; i < c.cells.cells.size(); ++i)
    ASSERT_LE(c.cells.cells[i].length, std::min(c.raster.stored_length[i], static_cast<float>(kFrontMaxLength)));
}

TEST(Prolong, is_the_largest_field_that_respects_the_slope) {
  // between neighbours: never more than the slope; and each cell is either at its own bound, or exactly at a
  // neighbour's limit
  const Case c = make_case(2000);
  const Neighbours neighbours(c.view());
  int n_limited = 0;
  for (std::int32_t a = 0; a < c.view().n_leaves(); ++a) {
    const std::size_t i = static_cast<std::size_t>(a);
    float limit = std::min(c.raster.stored_length[i], static_cast<float>(kFrontMaxLength));
    const float own = limit;
    neighbours.for_each(a, [&](std::int32_t b, const CellStep&) {
      const double d = distance(c.view().leaf_center(a), c.view().leaf_center(b));
      limit = std::min(limit, static_cast<float>(c.cells.cells[b].length + kFrontSlope * d));
    });
    ASSERT_NEAR(c.cells.cells[i].length, limit, 1e-6F * limit);
    n_limited += c.cells.cells[i].length < own;
  }
  EXPECT_GT(n_limited, c.view().n_leaves() / 10);
}

TEST(Prolong, across_faces_is_larger_by_the_detours_alone) {
  const Case c = make_case(2000);
  const ProlongedLengths across = prolong(Neighbours(c.view()), c.raster.stored_length, c.raster.stored_cause,
                                          {kFrontSlope, kFrontMaxLength, {}, true, true});
  int n_larger = 0;
  for (std::size_t i = 0; i < across.cells.size(); ++i) {
    const double own = across.cells[i].length, straight = c.cells.cells[i].length;
    ASSERT_GE(own, straight);
    ASSERT_LE(own, std::sqrt(3.0) * straight * (1 + 1e-6));
    n_larger += own > straight;
  }
  EXPECT_GT(n_larger, 0);
}

TEST(Prolong, keeps_the_cause_of_the_length_it_passes_on) {
  std::vector<RasterBox> boxes{{{0.25, 0.5, 0.5}, 0.002F, 0.002F, pack_cause(CauseKind::kEdge, 11)},
                               {{0.75, 0.5, 0.5}, 0.004F, 0.004F, pack_cause(CauseKind::kFace, 5)}};
  const RasterOctree raster = build_octree(test::kUnitBox, boxes);
  const OctreeView view = raster.shape.view();
  const ProlongedLengths cells =
      prolong(Neighbours(view), raster.stored_length, raster.stored_cause, {kFrontSlope, 0.05});
  const auto cause_at = [&](Vec3 x) { return cells.cause[view.find_leaf(morton::encode(view.grid_point(x)))]; };
  EXPECT_EQ(cause_at({0.25, 0.5, 0.55}), boxes[0].cause);
  EXPECT_EQ(cause_at({0.75, 0.55, 0.5}), boxes[1].cause);
  EXPECT_EQ(cause_at({0.01, 0.01, 0.01}), kNone);
}

TEST(Prolong, does_nothing_without_stored_lengths) {
  const RasterOctree raster = build_octree(test::kUnitBox, {});
  const ProlongedLengths cells =
      prolong(Neighbours(raster.shape.view()), raster.stored_length, raster.stored_cause, {kFrontSlope, 0.5});
  ASSERT_EQ(cells.cells.size(), 1u);
  EXPECT_EQ(cells.cells[0].length, 0.5F);
  EXPECT_EQ(cells.cells[0].upper, 0.5F);
  EXPECT_EQ(cells.cells[0].gradient[0], 0);
  EXPECT_EQ(cells.cause, std::vector<std::int32_t>{kNone});
}

TEST(Prolong, gradient_is_the_slope_away_from_a_wall) {
  const RasterOctree raster = build_octree(test::kUnitBox, test::wall_boxes(0.02F));
  const OctreeView view = raster.shape.view();
  const ProlongedLengths cells =
      prolong(Neighbours(view), raster.stored_length, raster.stored_cause, {kFrontSlope, 10});
  for (const double x : {0.1, 0.2, 0.35, 0.6}) {
    const std::size_t leaf = static_cast<std::size_t>(view.find_leaf(morton::encode(view.grid_point({x, 0.5, 0.5}))));
    EXPECT_NEAR(cells.cells[leaf].gradient[0], kFrontSlope, 0.1 * kFrontSlope);
    EXPECT_NEAR(cells.cells[leaf].gradient[1], 0, 0.1 * kFrontSlope);
    EXPECT_NEAR(cells.cells[leaf].gradient[2], 0, 0.1 * kFrontSlope);
  }
}

TEST(Prolong, gradient_never_exceeds_the_slope_nor_leaves_the_neighbours_range) {
  const Case c = make_case(2000);
  const Neighbours neighbours(c.view());
  for (std::int32_t a = 0; a < c.view().n_leaves(); ++a) {
    const std::size_t i = static_cast<std::size_t>(a);
    float lo = c.cells.cells[i].length, hi = lo;
    neighbours.for_each(a, [&](std::int32_t b, const CellStep&) {
      lo = std::min(lo, c.cells.cells[b].length);
      hi = std::max(hi, c.cells.cells[b].length);
    });
    const float* g = c.cells.cells[i].gradient;
    const float reach = 0.5F * static_cast<float>(c.view().cell_edge(c.view().leaf_levels[i])) *
                        (std::abs(g[0]) + std::abs(g[1]) + std::abs(g[2]));
    ASSERT_LE(std::hypot(g[0], g[1], g[2]), kFrontSlope * 1.000001);
    ASSERT_EQ(c.cells.cells[i].upper, hi);
    ASSERT_GE(c.cells.cells[i].length - reach, lo * 0.999999F);
  }
}

/// Two spots; where lengths come from the second, another slope holds.
TEST(Prolong, slope_of_a_region_holds_where_lengths_come_from_it) {
  const std::vector<RasterBox> boxes{{{0.2, 0.5, 0.5}, 0.005F, 0.005F, pack_cause(CauseKind::kFace, 0)},
                                     {{0.8, 0.5, 0.5}, 0.005F, 0.005F, pack_cause(CauseKind::kFace, 1)}};
  const RasterOctree raster = build_octree(test::kUnitBox, boxes);
  const OctreeView view = raster.shape.view();
  ProlongOptions options{0.2, 10};
  std::vector<float> seeds(raster.stored_cause.size(), 0);
  for (std::size_t i = 0; i < seeds.size(); ++i)
    if (raster.stored_cause[i] == boxes[1].cause) seeds[i] = 0.05F;
  const std::vector<float> slopes = spread_slopes(Neighbours(view), raster.stored_length, seeds, options);
  options.cell_slope = slopes;
  const ProlongedLengths cells = prolong(Neighbours(view), raster.stored_length, raster.stored_cause, options);
  const auto at = [&](Vec3 x) { return view.find_leaf(morton::encode(view.grid_point(x))); };
  const auto expect_growth = [&](Vec3 from, Vec3 to, double slope) {
    const std::int32_t leaf = at(to);
    const double d = distance(from, view.leaf_center(leaf)), edge = view.cell_edge(view.leaf_levels[leaf]);
    EXPECT_NEAR(cells.cells[leaf].length, 0.005 + slope * d, slope * edge + 0.1 * slope * d);
    EXPECT_EQ(slopes[leaf], static_cast<float>(slope));
  };
  expect_growth({0.2, 0.5, 0.5}, {0.05, 0.5, 0.5}, 0.2);
  expect_growth({0.2, 0.5, 0.5}, {0.2, 0.8, 0.5}, 0.2);
  expect_growth({0.8, 0.5, 0.5}, {0.95, 0.5, 0.5}, 0.05);
  expect_growth({0.8, 0.5, 0.5}, {0.8, 0.5, 0.9}, 0.05);
}

}  // namespace
}  // namespace st
