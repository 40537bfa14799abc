#include "geometry/facet/facet_flaps.h"

#include <gtest/gtest.h>

#include "geometry/facet/facet_repair.h"
#include "unit/geometry/facet_inputs.h"

namespace st {
namespace {

/// A cube with the facets of a fin of `n` pairs that stands on its edge from node 0 to node 1.
FacetInput cube_with_fin(int n) {
  FacetInput in = test::cube_facets();
  std::int32_t a = 0;
  for (int i = 0; i < n; ++i) {
    const auto tip = static_cast<std::int32_t>(in.x.size());
    in.x.push_back({-1.0, -1.0, 0.2 * i});
    const std::int32_t b = i == 0 ? 1 : tip - 1;
    in.corners.push_back({a, b, tip});
    in.corners.push_back({tip, b, a});
  }
  in.part.assign(in.corners.size(), 0);
  return in;
}

std::vector<TwinFacets> pairs_of(const FacetInput& in) {
  std::vector<TwinFacets> pairs;
  for (std::int32_t t = 12; t < static_cast<std::int32_t>(in.corners.size()); t += 2) pairs.push_back({t, t + 1});
  return pairs;
}

TEST(FacetFlaps, hang_by_some_sides_and_end_freely) {
  const FacetInput one = cube_with_fin(1);
  EXPECT_EQ(find_flaps(one.corners, pairs_of(one)), pairs_of(one));
  const FacetInput sheet = cube_with_fin(2);
  EXPECT_TRUE(find_flaps(sheet.corners, pairs_of(sheet)).empty()) << "it may be meant";
  FacetInput alike = one;
  alike.corners[13] = alike.corners[12];
  EXPECT_TRUE(find_flaps(alike.corners, pairs_of(alike)).empty()) << "one facet given twice";
  const std::vector<Corners> apart{{0, 1, 2}, {2, 1, 0}};
  EXPECT_TRUE(find_flaps(apart, {{0, 1}}).empty()) << "a sheet with two sides";
}

TEST(FacetFlaps, go_when_facets_are_repaired) {
  FacetInput in = cube_with_fin(1);
  EXPECT_EQ(repair_facets(in).size(), 1u);
  EXPECT_EQ(in.corners, test::cube_facets().corners);
}

/// A vertex of two squares that lie on each other at one corner: both are divided by the same diagonal.
TEST(FacetFlaps, come_from_polygons_with_two_common_sides) {
  FacetInput in;
  in.x = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.4, 0.4, 1}};
  in.corners = {{0, 1, 2}, {0, 2, 3}, {2, 1, 0}, {2, 0, 4}, {3, 2, 4}, {0, 3, 4}};
  in.part.assign(6, 0);
  repair_facets(in);
  EXPECT_EQ(in.corners.size(), 4u) << "a tetrahedron of the others";
}

}  // namespace
}  // namespace st
