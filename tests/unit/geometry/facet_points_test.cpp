#include "geometry/facet/facet_points.h"

#include <gtest/gtest.h>

namespace st {
namespace {

TEST(FacetPoints, AtOnePlaceAreOneNode) {
  FacetInput facets;
  facets.x = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {-0.0, 1, -0.0}, {1, 1, 0}, {1, 1e-300, 0}, {1, 0, 0}};
  facets.corners = {{0, 1, 2}, {3, 5, 4}, {6, 5, 7}};
  join_equal_points(facets);
  EXPECT_EQ(facets.corners, (std::vector<Corners>{{0, 1, 2}, {1, 5, 2}, {6, 5, 1}}));
  EXPECT_EQ(facets.x.size(), 8u);
}

TEST(FacetPoints, AreFoundAmongMany) {
  FacetInput facets;
  constexpr std::int32_t kSide = 60;  // more than are sorted by comparison
  for (int copy = 0; copy < 2; ++copy)
    for (std::int32_t i = 0; i < kSide * kSide; ++i)
      facets.x.push_back({1.0 / (1 + i % kSide), 0.1 * (i / kSide), 0.5});
  for (std::int32_t i = 0; i < kSide * kSide; ++i) facets.corners.push_back({i, kSide * kSide + i, i});
  join_equal_points(facets);
  for (std::int32_t i = 0; i < kSide * kSide; ++i) EXPECT_EQ(facets.corners[i], (Corners{i, i, i}));
}

}  // namespace
}  // namespace st
