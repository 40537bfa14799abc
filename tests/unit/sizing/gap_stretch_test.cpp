#include "sizing/gap_stretch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/shape/analytic.h"
#include "sizing/end_stretch.h"
#include "sizing/gap_sizes.h"
#include "sizing/raster_face.h"

namespace st {
namespace {

const GapFinder::MeetingPlace kNoEdges = [](std::int32_t, std::int32_t, Vec3) { return std::nullopt; };

SamplingLimits stretched_limits(double max_length) {
  SamplingLimits result{0.001, max_length, radians(10), 2.5};
  result.gap_cells = 4;
  result.max_aspect = 20;
  return result;
}

/// A flat patch of 2 x 2 that may be stretched along `way`.
GapPatch flat_patch(Vec3 x, Vec3 normal, Vec3 way) {
  GapPatch patch;
  patch.shape.x = x;
  patch.shape.normal = normal;
  patch.shape.axis_s = {1, 0, 0};
  patch.shape.axis_t = cross(normal, patch.shape.axis_s);
  patch.shape.s_lo = patch.shape.t_lo = -1;
  patch.shape.s_hi = patch.shape.t_hi = 1;
  patch.stretch.max_aspect = 20;
  patch.stretch.max_length = 10;
  patch.stretch.alpha = radians(10);
  patch.way = way;
  return patch;
}

SampleStretch stretch_below(const GapPatch& patch, const GapPatch& above, double length = 0.01) {
  return gap_stretch(patch, {patch.shape.x, patch.shape.normal, &above, above.shape.x, length});
}

TEST(GapStretch, follows_the_patch_where_the_gap_is_even) {
  const GapPatch below = flat_patch({0, 0, 0}, {0, 0, 1}, {0, 1, 0}), above = flat_patch({0, 0, 0.04}, {0, 0, -1}, {});
  const SampleStretch stretch = stretch_below(below, above);
  EXPECT_NEAR(stretch.along, 0.2, 1e-6);
  EXPECT_GT(std::abs(Vec3(stretch.direction).y), 0.99);
}

TEST(GapStretch, follows_the_other_side_where_the_patch_has_no_direction) {
  const GapPatch below = flat_patch({0, 0, 0}, {0, 0, 1}, {}), above = flat_patch({0, 0, 0.04}, {0, 0, -1}, {0, 1, 0});
  const SampleStretch stretch = stretch_below(below, above);
  EXPECT_NEAR(stretch.along, 0.2, 1e-6);
  EXPECT_GT(std::abs(Vec3(stretch.direction).y), 0.99);
}

TEST(GapStretch, follows_the_line_along_which_both_sides_run) {
  // the other side leans by 20 degrees about x: the gap stays as wide along x, the patch has its lengths along y
  const Vec3 leaning{0, std::sin(radians(20)), -std::cos(radians(20))};
  const GapPatch below = flat_patch({0, 0, 0}, {0, 0, 1}, {0, 1, 0}), above = flat_patch({0, 0, 0.04}, leaning, {});
  const SampleStretch stretch = stretch_below(below, above);
  EXPECT_NEAR(stretch.along, 0.2, 1e-6);
  EXPECT_GT(std::abs(Vec3(stretch.direction).x), 0.99);
}

/// Whatever the lengths of either side: both are to have the same rows.
TEST(GapStretch, follows_the_edge_of_a_wedge) {
  const Vec3 leaning{0, std::sin(radians(14)), -std::cos(radians(14))};
  GapPatch below = flat_patch({0, 0, 0}, {0, 0, 1}, {0, 1, 0});
  const GapPatch above = flat_patch({0, 0, 0.04}, leaning, {0, 1, 0});
  below.end = {0, 1, 0};
  const SampleStretch stretch = stretch_below(below, above);
  EXPECT_NEAR(stretch.along, kEndAspect * 0.01, 1e-6);
  EXPECT_GT(std::abs(Vec3(stretch.direction).x), 0.99);
}

/// Where the gap asks for less than the least length.
TEST(GapStretch, of_a_patch_so_large_that_it_does_not_see_the_gap_is_that_of_its_length) {
  GapPatch wall = flat_patch({0, 0, 0}, {0, 0, 1}, {0, 1, 0}), small = flat_patch({0, 0, 0.04}, {0, 0, -1}, {0, 1, 0});
  small.shape.s_lo = small.shape.t_lo = -0.1;
  small.shape.s_hi = small.shape.t_hi = 0.1;
  wall.cause = 1;
  for (GapPatch* patch : {&wall, &small}) {
    patch->length = 1;
    patch->min_length = 0.05;
    patch->gap_cells = 8;
  }
  const std::vector<GapPatch> patches = {wall, small};
  std::vector<RasterBox> boxes;
  GapFinder(patches, 2.5, kNoEdges).add_boxes(1, boxes);
  ASSERT_TRUE(std::ranges::any_of(boxes, [](const RasterBox& b) { return b.cause == 1; }));
  for (const RasterBox& box : boxes) EXPECT_NEAR(box.stretch.along, 20 * box.length, 1e-4) << box.cause;
}

TEST(GapStretch, ends_where_one_of_both_sides_bends_along_it) {
  const GapPatch below = flat_patch({0, 0, 0}, {0, 0, 1}, {0, 1, 0});
  GapPatch above = flat_patch({0, 0, 0.04}, {0, 0, -1}, {});
  above.shape.k_tt = 1;
  EXPECT_NEAR(stretch_below(below, above).along, std::sqrt(radians(10) * 0.01), 1e-6);
  above.shape.k_tt = 100;
  EXPECT_EQ(stretch_below(below, above).along, 0);
}

TEST(GapStretch, is_bounded_where_the_face_ends_across_it) {
  const GapPatch above = flat_patch({0, 0, 0.04}, {0, 0, -1}, {});
  GapPatch below = flat_patch({0, 0, 0}, {0, 0, 1}, {0, 1, 0});
  below.end = {1, 0, 0};
  EXPECT_NEAR(stretch_below(below, above).along, kEndAspect * 0.01, 1e-6);
  below.end = {0, 1, 0};
  EXPECT_NEAR(stretch_below(below, above).along, 0.2, 1e-6);
}

TEST(GapStretch, is_none_of_patches_without_a_direction_or_an_aspect) {
  const GapPatch above = flat_patch({0, 0, 0.04}, {0, 0, -1}, {});
  GapPatch below = flat_patch({0, 0, 0}, {0, 0, 1}, {});
  EXPECT_EQ(stretch_below(below, above).along, 0);
  below.way = {0, 1, 0};
  below.stretch.max_aspect = 1;
  EXPECT_EQ(stretch_below(below, above).along, 0);
}

/// A rod of radius 1 along z in a bore of 1.1.
TEST(GapStretch, of_a_rod_in_its_bore_is_along_both_on_both_sides) {
  const Frame frame{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<GapPatch> patches;
  for (const double radius : {1.0, 1.1}) {
    std::vector<RasterBox> boxes;
    std::vector<GapPatch> own;
    const AxialSurface surface(SurfaceType::kCylinder, frame, radius, 0, 0, 2 * kPi, 0, 10);
    raster_face(surface, {}, stretched_limits(1), radius > 1 ? 1 : 0, boxes, &own);
    if (radius > 1)
      for (GapPatch& patch : own) patch.shape.flip();
    patches.insert(patches.end(), own.begin(), own.end());
  }
  std::vector<RasterBox> boxes;
  const GapFinder finder(patches, 2.5, kNoEdges);
  for (std::size_t i = 0; i < patches.size(); ++i) finder.add_boxes(i, boxes);
  ASSERT_FALSE(boxes.empty());
  for (const RasterBox& box : boxes) {
    EXPECT_NEAR(box.length, 0.025, 0.001);
    EXPECT_NEAR(box.stretch.along, 20 * box.length, 0.01) << box.center.z;
    EXPECT_GT(std::abs(Vec3(box.stretch.direction).z), 0.99);
  }
}

}  // namespace
}  // namespace st
