#include "geometry/facet/short_sides.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "unit/geometry/facet_inputs.h"

namespace st {
namespace {

/// Puts a further node beside a node, between two facets around it that are not neighbours of each other: two needles
/// lie between them.
void double_node(FacetInput& in, std::int32_t node, Vec3 away) {
  std::vector<std::int32_t> fan;  // facets around the node, each the neighbour of the one before
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(in.corners.size()); ++t)
    if (std::ranges::count(in.corners[t], node) > 0) fan.push_back(t);
  const auto next_of = [&](std::int32_t t) {
    const Corners& c = in.corners[t];
    return c[(std::ranges::find(c, node) - c.begin() + 1) % 3];
  };
  const std::int32_t twin = static_cast<std::int32_t>(in.x.size()), first = next_of(fan[0]);
  in.x.push_back(in.x[node] + away);
  std::int32_t rim = first;
  for (std::size_t moved = 0; moved < fan.size() / 2; ++moved) {
    const auto t = *std::ranges::find_if(
        fan, [&](std::int32_t f) { return std::ranges::count(in.corners[f], node) > 0 && next_of(f) == rim; });
    const Corners c = in.corners[t];
    rim = c[(std::ranges::find(c, node) - c.begin() + 2) % 3];
    std::ranges::replace(in.corners[t], node, twin);
  }
  in.corners.push_back({node, first, twin});
  in.corners.push_back({node, twin, rim});
  in.part.assign(in.corners.size(), 0);
}

TEST(ShortSides, become_points_where_only_rounding_parts_their_ends) {
  const FacetInput sound = test::sphere_facets(12, 1, {3, 0, 0});
  FacetInput in = sound;
  for (const std::int32_t node : {10, 60, 100}) double_node(in, node, {1e-16, 1e-18, 0});
  ASSERT_EQ(in.corners.size(), sound.corners.size() + 6);
  EXPECT_EQ(join_ends_of_short_sides(in, 1e-6), 3u);
  std::multiset<std::set<std::int32_t>> left, before;
  for (const Corners& c : in.corners) left.emplace(c.begin(), c.end());
  for (const Corners& c : sound.corners) before.emplace(c.begin(), c.end());
  EXPECT_EQ(left, before);
}

TEST(ShortSides, stay_where_coordinates_tell_their_ends_apart) {
  FacetInput in = test::sphere_facets(12, 1, {3, 0, 0});
  double_node(in, 10, {1e-5, 0, 0});
  const auto corners = in.corners;
  EXPECT_EQ(join_ends_of_short_sides(in, 1), 0u);
  FacetInput fine = test::sphere_facets(12, 1e-7, {3, 0, 0});
  EXPECT_EQ(join_ends_of_short_sides(fine, 1e-12), 0u);
  EXPECT_EQ(in.corners, corners);
}

TEST(ShortSides, stay_where_the_surface_would_close_on_itself) {
  FacetInput in;  // a tetrahedron: without the side two facets lie on each other
  in.x = {{0, 0, 1}, {1e-17, 0, 1}, {1, 0, 0}, {0, 1, 0}};
  in.corners = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  in.part.assign(4, 0);
  EXPECT_EQ(join_ends_of_short_sides(in, 1e-6), 0u);
  FacetInput tube = test::grid_facets(3, 6, [](int i, int j) {
    const double a = 2 * kPi * (i % 3) / 3, r = 1e-17;
    return Vec3{2 + r * std::cos(a), r * std::sin(a), j * 1.0};
  });
  EXPECT_EQ(join_ends_of_short_sides(tube, 1e-6), 0u);
}

/// A wing of one chord and span whose section has these places behind its nose, from above the trailing edge to below.
FacetInput wing_facets(const std::vector<Vec3>& behind) {
  FacetInput in;
  const auto n = static_cast<std::int32_t>(behind.size()) + 1;
  for (const double y : {0.0, 1.0}) {
    in.x.push_back({0, y, 0});
    for (const Vec3 p : behind) in.x.push_back({p.x, y, p.z});
  }
  for (std::int32_t i = 0; i < n; ++i) {
    const std::int32_t next = (i + 1) % n;
    in.corners.push_back({i, i + n, next});
    in.corners.push_back({next, i + n, next + n});
  }
  for (std::int32_t i = 1; i + 1 < n; ++i) {
    in.corners.push_back({0, i, i + 1});
    in.corners.push_back({n, n + i + 1, n + i});
  }
  in.part.assign(in.corners.size(), 0);
  return in;
}

TEST(ShortSides, stay_at_the_point_of_a_tip) {
  FacetInput sharp = wing_facets({{0.999999, 0, 9e-8}, {1, 0, 0}, {0.999999, 0, -9e-8}});
  sharp.corners[8] = {1, 2, 3};  // as tips are cut into strips: one facet behind the two places
  sharp.corners[9] = {0, 1, 3};
  const auto corners = sharp.corners;
  EXPECT_EQ(join_ends_of_short_sides(sharp, 1e-6), 0u);
  EXPECT_EQ(sharp.corners, corners);
  FacetInput blunt = wing_facets({{1, 0, 9e-8}, {1, 0, -9e-8}});
  EXPECT_EQ(join_ends_of_short_sides(blunt, 1e-6), 2u);
}

}  // namespace
}  // namespace st
