#include "geometry/facet/facet_repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "unit/geometry/facet_inputs.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

double volume_of(const FacetInput& in) {
  double volume = 0;
  for (const Corners& c : in.corners) volume += dot(in.x[c[0]], cross(in.x[c[1]], in.x[c[2]])) / 6;
  return volume;
}

void append_facets(FacetInput& in, const FacetInput& more) {
  const auto first = static_cast<std::int32_t>(in.x.size());
  in.x.insert(in.x.end(), more.x.begin(), more.x.end());
  for (const Corners& c : more.corners) in.corners.push_back({first + c[0], first + c[1], first + c[2]});
  in.part.resize(in.corners.size(), 0);
}

bool has_kind(const std::vector<ImportFinding>& findings, FindingKind kind) {
  return std::any_of(findings.begin(), findings.end(), [&](const ImportFinding& f) { return f.kind == kind; });
}

TEST(FacetRepair, leaves_alone_what_is_sound) {
  FacetInput in = test::torus_facets(20, 10);
  const auto corners = in.corners;
  EXPECT_TRUE(repair_facets(in).empty());
  EXPECT_EQ(in.corners, corners);
}

/// The sphere as facets with nodes of their own, each off by some 1e-7 and a part of its own, as readers number them.
FacetInput loose_facets() {
  const FacetInput whole = test::sphere_facets(12);
  FacetInput loose;
  for (const Corners& c : whole.corners) {
    const auto first = static_cast<std::int32_t>(loose.x.size());
    for (std::int32_t k = 0; k < 3; ++k)
      loose.x.push_back(whole.x[c[k]] + 1e-7 * Vec3{std::sin(first + k), std::cos(first + k), 0});
    loose.part.push_back(static_cast<std::int32_t>(loose.corners.size()));
    loose.corners.push_back({first, first + 1, first + 2});
  }
  loose.part_name.resize(loose.corners.size());
  return loose;
}

TEST(FacetRepair, makes_one_part_of_parts_that_gaps_alone_divided) {
  FacetInput in = loose_facets();
  EXPECT_TRUE(has_kind(repair_facets(in), FindingKind::kJoinedNodes));
  EXPECT_EQ(in.x.size(), test::sphere_facets(12).x.size());
  EXPECT_EQ(in.part, std::vector<std::int32_t>(in.corners.size(), 0));
  FacetInput named = loose_facets();
  named.part_name[5] = "hatch";
  repair_facets(named);
  EXPECT_EQ(std::ranges::count(named.part, 5), 1);
  EXPECT_EQ(std::ranges::count(named.part, 0), static_cast<std::ptrdiff_t>(named.corners.size()) - 1);
}

TEST(FacetRepair, leaves_solids_that_share_nodes_in_the_file_apart) {
  FacetInput in = loose_facets();
  in.corners.push_back(in.corners[0]);
  in.corners.back()[2] = static_cast<std::int32_t>(in.x.size());
  in.x.push_back({0, 0, 5});
  in.part.push_back(1);
  repair_facets(in);
  EXPECT_GT(std::ranges::count_if(in.part, [](std::int32_t part) { return part > 1; }), 0);
}

TEST(FacetRepair, turns_facets_as_most_of_their_neighbours_are) {
  FacetInput in = test::sphere_facets(12);
  for (std::size_t t = 0; t < in.corners.size(); t += 5) std::swap(in.corners[t][0], in.corners[t][1]);
  EXPECT_TRUE(has_kind(repair_facets(in), FindingKind::kTurnedFacets));
  EXPECT_NEAR(volume_of(in), volume_of(test::sphere_facets(12)), 1e-12);
}

TEST(FacetRepair, turns_a_body_that_is_inside_out_but_no_cavity) {
  FacetInput in = test::sphere_facets(12);
  for (Corners& c : in.corners) std::swap(c[0], c[1]);
  FacetInput hollow = test::sphere_facets(12, 2);
  append_facets(hollow, in);
  const double volume = volume_of(hollow);
  repair_facets(in);
  EXPECT_GT(volume_of(in), 0);
  EXPECT_TRUE(repair_facets(hollow).empty());
  EXPECT_EQ(volume_of(hollow), volume);
}

TEST(FacetRepair, drops_duplicates_points_and_unused_nodes) {
  FacetInput in = test::cube_facets();
  in.corners.push_back({in.corners[3][2], in.corners[3][1], in.corners[3][0]});
  in.corners.push_back({1, 1, 2});
  in.x.push_back({9, 9, 9});
  in.part.assign(in.corners.size(), 0);
  EXPECT_TRUE(has_kind(repair_facets(in), FindingKind::kDuplicateFacets));
  EXPECT_EQ(in.corners, test::cube_facets().corners);
  EXPECT_EQ(in.x.size(), 8u);
}

/// Facets over the corners 0 to 3 of a square whose diagonal, from 0 to 1, has further nodes at these shares.
FacetInput slit_square(const std::vector<Corners>& corners, const std::vector<double>& places) {
  FacetInput in;
  in.x = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
  for (const double s : places) in.x.push_back({s, s, 0});
  in.corners = corners;
  in.part.assign(in.corners.size(), 0);
  return in;
}

TEST(FacetRepair, drops_lines_without_neighbours_and_leaves_other_lone_facets) {
  FacetInput in = test::cube_facets();
  for (const double height : {1e-8, 0.1}) {
    const auto first = static_cast<std::int32_t>(in.x.size());
    for (const Vec3 x : {Vec3{2, 0, height}, Vec3{3, 0, height}, Vec3{2.5, height, height}}) in.x.push_back(x);
    in.corners.push_back({first, first + 1, first + 2});
  }
  in.part.assign(in.corners.size(), 0);
  EXPECT_EQ(repair_facets(in).size(), 1u);
  EXPECT_EQ(in.corners.size(), 13u);
  EXPECT_EQ(in.x.size(), 11u);
}

/// Two cubes of the parts 0 and 1 with a wall in common, cut by one diagonal or by both.
FacetInput two_cubes(bool has_both_diagonals) {
  FacetInput in = test::cube_facets();
  const std::int32_t beyond[8] = {4, 5, 6, 7, 8, 9, 10, 11};  // the nodes at x = 1 are those of the wall
  for (int n = 4; n < 8; ++n) in.x.push_back(in.x[n] + Vec3{1, 0, 0});
  for (std::size_t t = 0; t < 12; ++t) {
    const Corners c = in.corners[t];
    in.corners.push_back({beyond[c[0]], beyond[c[1]], beyond[c[2]]});
  }
  if (has_both_diagonals) in.corners[12] = {4, 5, 6}, in.corners[13] = {5, 7, 6};
  in.part.assign(24, 0);
  for (std::size_t t = 12; t < 24; ++t) in.part[t] = 1;
  in.part_name = {"a", "b"};
  return in;
}

TEST(FacetRepair, parts_closed_bodies_whose_common_wall_is_cut_in_two_ways) {
  FacetInput in = two_cubes(true);
  repair_facets(in);
  EXPECT_EQ(in.x.size(), 16u);
  EXPECT_NEAR(volume_of(in), 2, 1e-12);
  FacetInput common = two_cubes(false);
  repair_facets(common);
  EXPECT_EQ(common.x.size(), 12u) << "its facets are those of both, once";
  EXPECT_EQ(common.corners.size(), 22u);
}

TEST(FacetRepair, drops_both_of_two_facets_without_area) {
  FacetInput in = slit_square({{0, 1, 4}, {4, 1, 0}, {0, 2, 4}, {4, 2, 1}, {0, 4, 3}, {4, 1, 3}}, {0.5});
  EXPECT_TRUE(has_kind(repair_facets(in), FindingKind::kDuplicateFacets));
  EXPECT_EQ(in.corners, (std::vector<Corners>{{0, 2, 4}, {4, 2, 1}, {0, 4, 3}, {4, 1, 3}}));
}

TEST(FacetRepair, turns_a_line_on_a_line) {
  FacetInput in = slit_square({{0, 1, 4}, {5, 1, 0}, {0, 2, 5}, {5, 2, 1}, {0, 4, 3}, {4, 1, 3}}, {0.25, 0.5});
  repair_facets(in);
  double area = 0;
  for (const Corners& c : in.corners) {
    const double own = norm(cross(in.x[c[1]] - in.x[c[0]], in.x[c[2]] - in.x[c[0]])) / 2;
    EXPECT_GT(own, 0.05);
    area += own;
  }
  EXPECT_NEAR(area, 1, 1e-12);
  EXPECT_EQ(in.corners.size(), 6u);
}

// At a sharp edge, where the cap of one side looks like a part of the other.
TEST(FacetRepair, turns_the_long_side_of_a_low_cap_whatever_its_normal) {
  FacetInput in;
  in.x = {{0, 0, 0}, {0.5, -3e-4, 0}, {1, 0, 0}, {0.5, -20, 2}, {0.5, -20, -2}};
  in.corners = {{0, 3, 2}, {0, 2, 1}, {0, 1, 4}, {1, 2, 4}};
  in.part.assign(4, 0);
  in.part_name = {""};
  repair_facets(in);
  ASSERT_EQ(in.corners.size(), 4u);
  for (const Corners& c : in.corners) EXPECT_FALSE(std::ranges::count(c, 0) + std::ranges::count(c, 2) == 2);
}

TEST(FacetRepair, joins_free_nodes_in_almost_one_place) {
  FacetInput in = test::cube_facets();
  in.x.push_back(in.x[0] + Vec3{1e-7, 0, 0});
  in.corners[0][0] = 8;
  EXPECT_TRUE(has_kind(repair_facets(in), FindingKind::kJoinedNodes));
  EXPECT_EQ(in.x.size(), 8u);
  FacetInput far = test::cube_facets();
  far.x.push_back(far.x[0] + Vec3{1e-3, 0, 0});
  far.corners[0][0] = 8;
  EXPECT_FALSE(has_kind(repair_facets(far), FindingKind::kJoinedNodes));
}

TEST(FacetRepair, refuses_one_side_alone_and_nothing) {
  FacetInput strip;  // a Moebius strip of five facets
  for (int n = 0; n < 5; ++n) strip.x.push_back({std::cos(1.2566 * n), std::sin(1.2566 * n), 0.1 * n});
  for (int n = 0; n < 5; ++n) strip.corners.push_back({n, (n + 1) % 5, (n + 2) % 5});
  strip.part.assign(5, 0);
  EXPECT_ERROR(repair_facets(strip), kGeometry, "one side alone");
  FacetInput nothing;
  nothing.x = {{0, 0, 0}, {1, 0, 0}};
  nothing.corners = {{0, 1, 1}};
  nothing.part = {0};
  EXPECT_ERROR(repair_facets(nothing), kGeometry, "no facet");
  FacetInput flat;
  flat.x = {{10, 10, 10}, {4, 4, 4}, {5, 5, 5}};
  flat.corners = {{0, 1, 2}};
  flat.part = {0};
  EXPECT_ERROR(repair_facets(flat), kGeometry, "no facet has an area");
}

}  // namespace
}  // namespace st
