#include "sizing/gap_sizes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/shape/analytic.h"
#include "sizing/raster_face.h"

namespace st {
namespace {

const Frame kGapFrame{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

SamplingLimits limits(double max_length, double min_length, int gap_cells = 4) {
  SamplingLimits result{min_length, max_length, radians(10), 2};
  result.gap_cells = result.wall_cells = gap_cells;
  return result;
}

enum class Normals { kAlong, kAgainst };

/// Adds the patches of a surface, with normals along or against du x dv; `cause` tells surfaces apart.
void add_patches(const Surface& surface, Normals normals, const SamplingLimits& own, std::vector<GapPatch>& patches,
                 std::int32_t cause = 0, const LoopPolygons& loops = {}) {
  std::vector<RasterBox> boxes;
  std::vector<GapPatch> found;
  raster_face(surface, loops, own, cause, boxes, &found);
  if (normals == Normals::kAgainst)
    for (GapPatch& p : found) p.shape.flip();
  patches.insert(patches.end(), found.begin(), found.end());
}

PlaneSurface plate(double z) { return PlaneSurface({{0, 0, z}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 0, 10, 0, 10); }

std::optional<Vec3> nowhere(std::int32_t, std::int32_t, Vec3) { return std::nullopt; }

std::vector<RasterBox> gaps(const std::vector<GapPatch>& patches,
                            const GapFinder::MeetingPlace& meeting_place = nowhere) {
  const GapFinder finder(patches, 2, meeting_place);
  std::vector<RasterBox> boxes;
  for (std::size_t i = 0; i < patches.size(); ++i) finder.add_boxes(i, boxes);
  return boxes;
}

/// Smallest length of the boxes of a cause at x; 0 where there is none.
double length_at(const std::vector<RasterBox>& boxes, Vec3 x, std::int32_t cause) {
  double length = 0;
  for (const RasterBox& b : boxes)
    if (b.cause == cause && std::abs(b.center.x - x.x) <= b.half && std::abs(b.center.y - x.y) <= b.half &&
        std::abs(b.center.z - x.z) <= b.half && (length == 0 || b.length < length))
      length = b.length;
  return length;
}

TEST(GapSizes, put_n_lengths_between_two_plates_everywhere) {
  for (const bool is_slot : {true, false}) {  // a slot, a solid plate
    std::vector<GapPatch> patches;
    add_patches(plate(0), is_slot ? Normals::kAlong : Normals::kAgainst, limits(1, 0.01), patches, 0);
    add_patches(plate(0.4), is_slot ? Normals::kAgainst : Normals::kAlong, limits(1, 0.01), patches, 1);
    const std::vector<RasterBox> boxes = gaps(patches);
    for (const RasterBox& b : boxes) EXPECT_NEAR(b.length, 0.1, 1e-6);
    for (double x = 0.05; x < 10; x += 0.3)
      for (const int side : {0, 1}) EXPECT_GT(length_at(boxes, {x, 5.03, 0.4 * side}, side), 0) << x << " " << side;
    EXPECT_LT(boxes.size(), 2.2 * 100 / (0.15 * 0.15)) << "tiles about as large as their boxes";
  }
}

TEST(GapSizes, tell_gaps_in_the_flow_from_walls) {
  for (const bool is_slot : {true, false})
    for (const bool wants_gaps : {true, false}) {
      SamplingLimits own = limits(1, 0.01);
      (wants_gaps ? own.wall_cells : own.gap_cells).reset();
      std::vector<GapPatch> patches;
      add_patches(plate(0), is_slot ? Normals::kAlong : Normals::kAgainst, own, patches, 0);
      add_patches(plate(0.4), is_slot ? Normals::kAgainst : Normals::kAlong, own, patches, 1);
      EXPECT_EQ(gaps(patches).empty(), is_slot != wants_gaps) << is_slot << wants_gaps;
    }
}

/// Two triangles over (0, 0), (10, 0), (0, `width`) that meet at their longest sides at 10 degrees: both sides of a
/// slot or of a wing. Patches of both go on beyond that edge.
std::vector<RasterBox> gaps_at_sharp_edge(double width, bool is_slot) {
  const double steep = std::tan(radians(10)) / std::hypot(1, 10 / width), flat = steep * 10 / width;
  const Vec3 up = normalized(Vec3{steep, flat, 1}), along = normalized(Vec3{1, 0, -steep}), across = cross(up, along);
  const Vec3 corner{0, 0, 10 * steep};
  const auto uv = [&](double x, double y) {
    const Vec3 d = Vec3{x, y, steep * (10 - x) - flat * y} - corner;
    return Vec2{dot(d, along), dot(d, across)};
  };
  const Vec2 a = uv(0, 0), b = uv(10, 0), c = uv(0, width);
  const PlaneSurface leaning({corner, along, across, up}, -1, 11, -1, 11);
  const LoopPolygons below({{{0, 0}, {10, 0}}, {{10, 0}, {0, width}}, {{0, width}, {0, 0}}});
  SamplingLimits own = limits(1, 0.001);
  own.wall_cells.reset();
  std::vector<GapPatch> patches;
  add_patches(plate(0), is_slot ? Normals::kAlong : Normals::kAgainst, own, patches, 0, below);
  add_patches(leaning, is_slot ? Normals::kAgainst : Normals::kAlong, own, patches, 1,
              LoopPolygons({{a, b}, {b, c}, {c, a}}));
  return gaps(patches);
}

TEST(GapSizes, see_no_gap_beyond_a_sharp_edge_but_the_end_of_a_slot) {
  // Most of these edges leave a patch near its corner.
  for (const double width : {10.0, 9.0, 7.0, 5.0, 3.0, 2.0, 1.3}) {
    EXPECT_LT(gaps_at_sharp_edge(width, false).size(), 10) << width << ": a few where a side ends in a point";
    const std::vector<RasterBox> boxes = gaps_at_sharp_edge(width, true);
    EXPECT_LT(length_at(boxes, {4.7, 0.47 * width, 0}, 0), 0.03) << width;
    EXPECT_LT(length_at(boxes, {4.95, 0.495 * width, 0}, 0), 0.01) << width;
  }
}

/// Two plates over [0, 10] x [0, 10], the upper one with its normals down, `height` above the other at x = 0 and turned
/// by `angle` there. `has_edge`: they bound one edge, along x = 0.
std::vector<RasterBox> gaps_of_wedge(double height, double angle, bool has_edge) {
  const PlaneSurface upper(
      {{0, 0, height}, {std::cos(angle), 0, std::sin(angle)}, {0, 1, 0}, {-std::sin(angle), 0, std::cos(angle)}}, 0, 10,
      0, 10);
  SamplingLimits own = limits(1, 0.001);
  own.wall_cells.reset();
  std::vector<GapPatch> patches;
  add_patches(plate(0), Normals::kAlong, own, patches, 0);
  add_patches(upper, Normals::kAgainst, own, patches, 1);
  return gaps(patches, [&](std::int32_t a, std::int32_t b, Vec3 x) {
    return has_edge && a != b ? std::optional(Vec3{0, x.y, 0}) : std::nullopt;
  });
}

TEST(GapSizes, see_no_gap_that_closes_towards_a_common_edge) {
  for (const double angle : {5.0, 20.0, 40.0}) {
    EXPECT_TRUE(gaps_of_wedge(0, radians(angle), true).empty()) << angle;
    EXPECT_LT(length_at(gaps_of_wedge(0, radians(angle), false), {0.3, 5, 0}, 0), 0.1) << angle;
  }
  // slots whose end is the edge: of even height, and opening
  EXPECT_NEAR(length_at(gaps_of_wedge(0.4, 0, true), {5, 5, 0}, 0), 0.1, 1e-6);
  EXPECT_NEAR(length_at(gaps_of_wedge(1, radians(3), true), {2, 5, 0}, 0), 0.27, 0.03);
}

TEST(GapSizes, see_no_gap_that_closes_where_two_solids_cross) {
  const double angle = 0.3;
  const PlaneSurface leaning(
      {{0, 0, 1}, {std::cos(angle), 0, -std::sin(angle)}, {0, 1, 0}, {std::sin(angle), 0, std::cos(angle)}}, 0, 10, 0,
      10);
  std::vector<GapPatch> patches;
  add_patches(plate(0), Normals::kAlong, limits(1, 0.001), patches, 0);
  add_patches(leaning, Normals::kAgainst, limits(1, 0.001), patches, 1);
  EXPECT_LT(length_at(gaps(patches), {3, 5, 0}, 0), 0.1);
  for (GapPatch& p : patches) {
    p.solid = p.cause;
    p.stretch.max_aspect = 20;
  }
  for (const RasterBox& b : gaps(patches)) EXPECT_GT(b.length, 0.3) << b.center.x << " " << b.center.y;
}

TEST(GapSizes, see_no_wall_between_two_solids_and_no_gap_where_a_shaft_fills_its_bore) {
  const auto cylinder = [](double radius, double turned) {
    return AxialSurface(SurfaceType::kCylinder, kGapFrame, radius, 0, turned, turned + 2 * kPi, 0, 1);
  };
  for (const double bore : {1.0, 1.02}) {
    std::vector<GapPatch> patches;
    const SamplingLimits own = limits(0.5, 1e-4, 2);
    add_patches(cylinder(1, 0), Normals::kAlong, own, patches, 0);
    const std::size_t n_shaft = patches.size();
    add_patches(cylinder(bore, 0.1), Normals::kAgainst, own, patches, 1);
    for (std::size_t i = 0; i < patches.size(); ++i) patches[i].solid = i < n_shaft ? 0 : 1;
    double least = 1;
    for (const RasterBox& b : gaps(patches)) least = std::min(least, static_cast<double>(b.length));
    if (bore > 1) {
      EXPECT_NEAR(least, 0.01, 0.001);
    } else {
      EXPECT_GT(least, 0.1) << "the shaft itself is 2 thick";
    }
  }
}

TEST(GapSizes, take_the_smaller_length_of_a_gap_and_a_wall) {
  SamplingLimits own = limits(1, 0.01);
  own.gap_cells = 2;
  own.wall_cells = 5;
  std::vector<GapPatch> patches;
  add_patches(plate(0), Normals::kAlong, own, patches, 0);  // 0.2 of flow ahead, 0.4 of material behind
  add_patches(plate(0.2), Normals::kAgainst, own, patches, 1);
  add_patches(plate(-0.4), Normals::kAgainst, own, patches, 2);
  const std::vector<RasterBox> boxes = gaps(patches);
  EXPECT_NEAR(length_at(boxes, {5, 5, 0}, 0), 0.08, 1e-6) << "0.4 / 5, not 0.2 / 2";
  EXPECT_NEAR(length_at(boxes, {5, 5, 0.2}, 1), 0.1, 1e-6);
}

TEST(GapSizes, ask_for_nothing_without_a_facing_surface) {
  const auto boxes_with_second = [](double z, Normals normals) {
    std::vector<GapPatch> patches;
    add_patches(plate(0), Normals::kAlong, limits(1, 0.01), patches);
    add_patches(plate(z), normals, limits(1, 0.01), patches);
    return gaps(patches).size();
  };
  EXPECT_EQ(boxes_with_second(0.4, Normals::kAlong), 0u) << "normals alike";
  EXPECT_EQ(boxes_with_second(4.1, Normals::kAgainst), 0u) << "a gap that holds four lengths as it is";
  EXPECT_EQ(boxes_with_second(1e-6, Normals::kAgainst), 0u) << "touching surfaces";
  EXPECT_GT(boxes_with_second(3.9, Normals::kAgainst), 0u);
}

TEST(GapSizes, stay_above_the_smallest_length_and_keep_to_the_faces_that_ask) {
  std::vector<GapPatch> patches;
  add_patches(plate(0), Normals::kAlong, limits(1, 0.2), patches, 0);
  SamplingLimits silent = limits(1, 0.01);
  silent.gap_cells.reset();
  silent.wall_cells.reset();
  add_patches(plate(0.4), Normals::kAgainst, silent, patches, 1);
  const std::vector<RasterBox> boxes = gaps(patches);
  ASSERT_FALSE(boxes.empty());
  for (const RasterBox& b : boxes) {
    EXPECT_NEAR(b.length, 0.2, 1e-6);
    EXPECT_EQ(b.cause, 0);
  }
}

TEST(GapSizes, go_down_to_the_floor_of_a_slot_on_both_sides_unless_a_rule_has_its_own) {
  for (const bool is_ruled : {false, true}) {
    SamplingLimits wing = limits(1, 0.2);
    wing.gap_floor = 0.05;
    std::vector<GapPatch> patches;
    add_patches(plate(0), Normals::kAlong, wing, patches, 0);
    add_patches(plate(0.4), Normals::kAgainst, limits(1, 0.2), patches, 1);
    for (GapPatch& p : patches) p.keeps_floor = is_ruled && p.cause == 1;
    bool has_other = false;
    for (const RasterBox& b : gaps(patches)) {
      EXPECT_NEAR(b.length, is_ruled && b.cause == 1 ? 0.2 : 0.1, 1e-6);
      has_other |= b.cause == 1;
    }
    EXPECT_TRUE(has_other);
  }
}

TEST(GapSizes, see_only_the_part_inside_the_loops) {
  const LoopPolygons half({{{0, 0}, {5, 0}}, {{5, 0}, {5, 10}}, {{5, 10}, {0, 10}}, {{0, 10}, {0, 0}}});
  std::vector<GapPatch> patches;
  add_patches(plate(0), Normals::kAlong, limits(1, 0.01), patches, 0);
  add_patches(plate(0.4), Normals::kAgainst, limits(1, 0.01), patches, 1, half);
  const std::vector<RasterBox> boxes = gaps(patches);
  EXPECT_NEAR(length_at(boxes, {4.5, 5, 0}, 0), 0.1, 1e-6);
  EXPECT_EQ(length_at(boxes, {6.2, 5, 0}, 0), 0) << "further than a patch from the border";
  EXPECT_EQ(length_at(boxes, {6.2, 5, 0.4}, 1), 0);
}

TEST(GapSizes, leave_out_nothing_beside_a_slanted_border) {
  const LoopPolygons triangle({{{0, 0}, {10, 0}}, {{10, 0}, {0, 10}}, {{0, 10}, {0, 0}}});
  std::vector<GapPatch> patches;
  add_patches(plate(0), Normals::kAlong, limits(1, 0.01), patches, 0);
  add_patches(plate(0.4), Normals::kAgainst, limits(1, 0.01), patches, 1, triangle);
  const std::vector<RasterBox> boxes = gaps(patches);
  for (double x = 0.3; x < 9.6; x += 0.07)
    for (const int side : {0, 1}) {
      EXPECT_GT(length_at(boxes, {x, 9.8 - x, 0.4 * side}, side), 0) << x << " " << side;
      EXPECT_EQ(length_at(boxes, {x, 10.6 - x, 0.4 * side}, side), 0) << x << " " << side;
    }
}

TEST(GapSizes, of_a_curved_wall_are_its_thickness) {
  for (const double wall : {0.4, 0.05}) {  // far thinner than the sagitta of a patch
    const double height = 5 * wall;
    const AxialSurface outer(SurfaceType::kCylinder, kGapFrame, 10, 0, 0, 2 * kPi, 0, height);
    const AxialSurface inner(SurfaceType::kCylinder, kGapFrame, 10 - wall, 0, 0, 2 * kPi, 0, height);
    std::vector<GapPatch> patches;
    add_patches(outer, Normals::kAlong, limits(5, 0.01), patches, 0);
    add_patches(inner, Normals::kAgainst, limits(5, 0.01), patches, 1);
    const std::vector<RasterBox> boxes = gaps(patches);
    for (const RasterBox& b : boxes) ASSERT_NEAR(b.length, wall / 4, 0.02 * wall / 4);
    for (double angle = 0; angle < 6.28; angle += 0.05)
      for (const int side : {0, 1}) {
        const double r = 10 - side * wall;
        EXPECT_GT(length_at(boxes, {r * std::cos(angle), r * std::sin(angle), 0.51 * height}, side), 0) << angle;
      }
  }
}

TEST(GapSizes, of_a_sphere_in_a_box_follow_the_distance_along_the_normal) {
  const double radius = 4, distance = 0.5;  // from the bottom of the sphere to a plane
  const AxialSurface sphere(SurfaceType::kSphere, {{5, 5, radius + distance}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, radius,
                            0, 0, 2 * kPi, -kPi / 2, kPi / 2);
  std::vector<GapPatch> patches;
  add_patches(plate(0), Normals::kAlong, limits(1, 0.01), patches, 0);
  add_patches(sphere, Normals::kAlong, limits(1, 0.01), patches, 1);
  const std::vector<RasterBox> boxes = gaps(patches);
  for (double r = 0; r < 2; r += 0.1) {
    // along the plane's normal; a box takes the smallest gap of its tile and reaches further than that
    const double gap = distance + radius - std::sqrt(radius * radius - r * r);
    const double inner = std::max(0.0, r - 2.5 * gap / 4);
    const double smallest = distance + radius - std::sqrt(radius * radius - inner * inner);
    const double length = length_at(boxes, {5 + r, 5, 0}, 0);
    const double asked = gap / 4;
    if (asked > 0.6) continue;
    EXPECT_LE(length, asked * 1.01) << r;
    EXPECT_GE(length, smallest / 4 * 0.99) << r;
  }
}

TEST(GapSizes, of_a_small_body_above_a_large_wall_are_found_from_both) {
  const AxialSurface ball(SurfaceType::kSphere, {{5.3, 5.2, 0.35}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 0.25, 0, 0,
                          2 * kPi, -kPi / 2, kPi / 2);
  std::vector<GapPatch> patches;
  add_patches(plate(0), Normals::kAlong, limits(1, 0.01), patches, 0);
  add_patches(ball, Normals::kAlong, limits(1, 0.01), patches, 1);
  const std::vector<RasterBox> boxes = gaps(patches);
  const double from_wall = length_at(boxes, {5.3, 5.2, 0}, 0), from_ball = length_at(boxes, {5.3, 5.2, 0.1}, 1);
  EXPECT_NEAR(from_ball, 0.025, 0.003);
  EXPECT_NEAR(from_wall, 0.025, 0.003) << "a patch of the wall is far larger than the ball";
}

}  // namespace
}  // namespace st
