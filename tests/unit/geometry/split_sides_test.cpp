#include "geometry/facet/split_sides.h"

#include <gtest/gtest.h>

#include "geometry/facet/facet_repair.h"
#include "unit/geometry/facet_inputs.h"

namespace st {
namespace {

std::size_t n_free_sides(const FacetInput& in) {
  std::size_t n = 0;
  for (const Corners& c : find_neighbours(in.corners)) n += std::ranges::count(c, kNone);
  return n;
}

/// A cube of which one facet is in pieces: n nodes on its longest side, none of which its neighbour has.
FacetInput cube_with_junctions(int n) {
  FacetInput in = test::cube_facets();
  const Corners c = in.corners[0];  // longest side: the last one
  std::int32_t from = c[2];
  for (int k = 1; k <= n; ++k) {
    const auto node = static_cast<std::int32_t>(in.x.size());
    in.x.push_back(in.x[c[2]] + k / (n + 1.0) * (in.x[c[0]] - in.x[c[2]]));
    in.corners.push_back({from, node, c[1]});
    in.part.push_back(0);
    from = node;
  }
  in.corners[0] = {from, c[0], c[1]};
  return in;
}

TEST(SplitSides, facets_that_end_on_a_side_divide_it) {
  for (const int n : {1, 2, 5}) {
    FacetInput in = cube_with_junctions(n);
    EXPECT_EQ(n_free_sides(in), n + 2u);
    EXPECT_EQ(split_sides_at_nodes(in, 1e-6), 1u);
    EXPECT_EQ(n_free_sides(in), 0u);
    EXPECT_EQ(in.corners.size(), 12u + 2 * n);
    EXPECT_EQ(in.part.size(), in.corners.size());
  }
}

TEST(SplitSides, several_sides_of_one_facet_are_divided) {
  FacetInput in = test::cube_facets();
  const auto center = static_cast<std::int32_t>(in.x.size());
  const Corners c = in.corners[0];
  in.corners.erase(in.corners.begin());  // its neighbours get nodes from four small ones
  in.part.pop_back();
  for (int k = 0; k < 3; ++k) in.x.push_back(0.5 * (in.x[c[k]] + in.x[c[(k + 1) % 3]]));
  in.corners.push_back({center, center + 1, center + 2});
  for (int k = 0; k < 3; ++k) in.corners.push_back({c[k], center + k, center + (k + 2) % 3});
  in.part.assign(in.corners.size(), 0);
  EXPECT_EQ(split_sides_at_nodes(in, 1e-6), 3u);
  EXPECT_EQ(n_free_sides(in), 0u);
}

TEST(SplitSides, sheets_stay_where_nothing_runs_along_their_sides) {
  FacetInput in;  // a triangle, and another one that touches its side in a point
  in.x = {{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, 0, 0}, {2, -1, 0}, {0, -1, 0}};
  in.corners = {{0, 1, 2}, {3, 5, 4}};
  in.part = {0, 0};
  EXPECT_EQ(split_sides_at_nodes(in, 1e-6), 0u);
  FacetInput sound = test::torus_facets(20, 10);
  EXPECT_EQ(split_sides_at_nodes(sound, 1e-6), 0u);
}

TEST(SplitSides, facets_that_end_on_a_side_are_told_from_others) {
  const std::vector<Vec3> x = {{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, 0, 0}, {2, -1, 0}, {0, -1, 0}, {1, 0.1, 0}};
  EXPECT_TRUE(ends_on_side(x, {0, 1, 2}, {3, 5, 4}, 1e-6));
  EXPECT_TRUE(ends_on_side(x, {3, 5, 4}, {0, 1, 2}, 1e-6));
  EXPECT_FALSE(ends_on_side(x, {0, 1, 2}, {6, 5, 4}, 1e-6));
  EXPECT_FALSE(ends_on_side(x, {0, 1, 2}, {0, 5, 1}, 1e-6)) << "a common side";
}

TEST(SplitSides, repair_closes_bodies_with_junctions) {
  FacetInput in = cube_with_junctions(2);
  EXPECT_EQ(repair_facets(in).size(), 1u);
  EXPECT_EQ(n_free_sides(in), 0u);
}

}  // namespace
}  // namespace st
