// Nodes joined across gaps: the narrowest that closes the facets.
#include "geometry/facet/facet_gaps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/facet/facet_sides.h"
#include "unit/geometry/facet_inputs.h"

namespace st {
namespace {

constexpr double kDiagonal = 3.4641016151377544;  // of the sphere's box

/// The sphere with nodes of its own at each facet, each off by `gap` diagonals in some direction.
FacetInput loose_sphere(double gap) {
  const FacetInput whole = test::sphere_facets(12);
  FacetInput loose;
  for (const Corners& c : whole.corners) {
    const auto first = static_cast<std::int32_t>(loose.x.size());
    for (std::int32_t k = 0; k < 3; ++k)
      loose.x.push_back(whole.x[c[k]] + gap * kDiagonal * Vec3{std::sin(first + k), std::cos(first + k), 0});
    loose.corners.push_back({first, first + 1, first + 2});
  }
  loose.part.assign(loose.corners.size(), 0);
  return loose;
}

int count_free(const FacetInput& in) {
  int n_free = 0;
  for_each_pair(sorted_sides(in.corners, in.x.size()), [&](std::span<const FacetSide> s) { n_free += s.size() == 1; });
  return n_free;
}

TEST(FacetGaps, are_closed_by_the_narrowest_of_three_widths_that_closes_them) {
  for (const auto& [off, width] : {std::pair(3e-7, 1e-6), std::pair(3e-6, 1e-5), std::pair(3e-5, 1e-4)}) {
    FacetInput in = loose_sphere(off);
    const JoinedGaps joined = join_gaps(in, kDiagonal);
    EXPECT_DOUBLE_EQ(joined.gap, width * kDiagonal);
    EXPECT_EQ(joined.n_nodes, in.x.size() - test::sphere_facets(12).x.size());
    EXPECT_TRUE(joined.had_free_sides);
    EXPECT_EQ(count_free(in), 0) << off;
  }
}

TEST(FacetGaps, wider_than_all_stay_open) {
  FacetInput in = loose_sphere(1e-3);
  const auto corners = in.corners;
  EXPECT_EQ(join_gaps(in, kDiagonal).n_nodes, 0u);
  EXPECT_EQ(in.corners, corners);
}

TEST(FacetGaps, leaves_closed_facets_and_lone_holes_alone) {
  FacetInput in = test::sphere_facets(12);
  EXPECT_FALSE(join_gaps(in, kDiagonal).had_free_sides);
  in.corners.pop_back();
  in.part.pop_back();
  const JoinedGaps joined = join_gaps(in, kDiagonal);
  EXPECT_EQ(joined.n_nodes, 0u);
  EXPECT_TRUE(joined.had_free_sides);
  EXPECT_DOUBLE_EQ(joined.gap, kFacetGap * kDiagonal);
}

// A rim of sides that are shorter than the wider gaps keeps its nodes.
TEST(FacetGaps, join_no_ends_of_short_sides) {
  FacetInput in;
  in.x = {{0, 0, 0}, {1, 0, 0}, {1, 3e-5, 0}, {0, 3e-5, 0}};
  in.corners = {{0, 1, 2}, {0, 2, 3}};
  in.part = {0, 0};
  EXPECT_EQ(join_gaps(in, 1).n_nodes, 0u);
}

}  // namespace
}  // namespace st
