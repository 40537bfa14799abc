#include "sizing/crossing_parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "geometry/shape/analytic.h"
#include "sizing/raster_face.h"

namespace st {
namespace {

constexpr double kHeight = 1, kAngle = 0.3;  // of the upper wall at x = 0, and how it leans: they meet at x = 3.2

struct Walls {
  double lower_end = 10;  // along x
  double max_aspect = 20;
  std::int32_t lower_solid = 1;
  bool is_round = false;  // the upper one: a cylinder above the other
};

void add_patches(const Surface& surface, bool is_down, std::int32_t solid, double max_aspect,
                 std::vector<GapPatch>& patches) {
  std::vector<RasterBox> boxes;
  std::vector<GapPatch> found;
  raster_face(surface, {}, SamplingLimits{0.01, 1, radians(10), 2}, solid, boxes, &found);
  for (GapPatch& p : found) {
    if (is_down) p.shape.flip();
    p.solid = solid;
    p.stretch.max_aspect = max_aspect;
  }
  patches.insert(patches.end(), found.begin(), found.end());
}

std::vector<GapPatch> patches_of(const Walls& walls) {
  std::vector<GapPatch> patches;
  const PlaneSurface lower({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 0, walls.lower_end, 0, 10);
  add_patches(lower, false, walls.lower_solid, walls.max_aspect, patches);
  if (walls.is_round) {
    const double radius = 5, clear = 0.2;
    const Frame frame{{3.5, 0, radius + clear}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
    add_patches(AxialSurface(SurfaceType::kCylinder, frame, radius, 0, 0.5, kPi - 0.5, 0, 10), false, 2,
                walls.max_aspect, patches);
  } else {
    const Frame frame{
        {0, 0, kHeight}, {std::cos(kAngle), 0, -std::sin(kAngle)}, {0, 1, 0}, {std::sin(kAngle), 0, std::cos(kAngle)}};
    add_patches(PlaneSurface(frame, 0, 10, 0, 10), true, 2, walls.max_aspect, patches);
  }
  return patches;
}

/// Whether the gap above (x, 5) on the lower wall is found, and closes where the walls cross.
bool closes_at(double x, const Walls& walls) {
  const std::vector<GapPatch> patches = patches_of(walls);
  const Vec3 from{x, 5, 0};
  bool is_seen = false, closes = false;
  for (const GapPatch& own : patches)
    for (const GapPatch& other : patches) {
      if (own.shape.normal.z < 0.99 || !(std::abs(from.x - own.shape.x.x) <= own.shape.s_hi) || &own == &other)
        continue;
      const auto d = other.shape.facing_distance(from, {0, 0, 1});
      if (!d || *d <= 0) continue;
      is_seen = true;
      closes |= CrossingParts(patches).cross_where_closed(own, other, from, *d);
    }
  EXPECT_TRUE(is_seen) << x;
  return closes;
}

TEST(CrossingParts, are_where_two_walls_close_until_one_is_inside_the_other) {
  for (const double x : {0.5, 1.5, 2.7, 3.1, 3.2}) EXPECT_TRUE(closes_at(x, {})) << x;
}

TEST(CrossingParts, are_none_of_one_solid_or_of_none) {
  EXPECT_FALSE(closes_at(2.7, {.lower_solid = 2}));
  EXPECT_FALSE(closes_at(2.7, {.lower_solid = -1}));
}

TEST(CrossingParts, are_none_where_a_wall_ends_before) {
  EXPECT_TRUE(closes_at(2.7, {.lower_end = 4}));
  EXPECT_FALSE(closes_at(2.7, {.lower_end = 3}));
}

TEST(CrossingParts, are_none_where_the_gap_has_a_throat) {
  for (const double x : {1.5, 2.5, 3.0, 3.4}) EXPECT_FALSE(closes_at(x, {.is_round = true})) << x;
}

TEST(CrossingParts, do_not_matter_where_triangles_have_equal_sides) { EXPECT_FALSE(closes_at(2.7, {.max_aspect = 1})); }

}  // namespace
}  // namespace st
