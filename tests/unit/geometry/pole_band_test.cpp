#include "geometry/model/pole_band.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

#include "support/shapes.h"

namespace st {
namespace {

TEST(PoleBand, fills_what_is_between_the_chains_once) {
  const PoleChain left{{0, 1, 2, 9}, {0, 0.5, 0.75, 1}}, right{{0, 3, 4, 5, 6, 9}, {0, 0.1, 0.2, 0.6, 0.9, 1}};
  const std::vector<Corners> facets = fill_pole_band(left, right);
  std::set<std::pair<std::int32_t, std::int32_t>> sides;
  for (const Corners& c : facets)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_TRUE(sides.emplace(c[k], c[(k + 1) % 3]).second);
  std::size_t n_rim = 0;
  for (const auto& [a, b] : sides) n_rim += !sides.contains({b, a});
  EXPECT_EQ(n_rim, 8u);
  for (std::size_t i = 0; i + 1 < left.node.size(); ++i)  // left of the way: passed backwards
    EXPECT_TRUE(sides.contains({left.node[i + 1], left.node[i]}));
  for (std::size_t i = 0; i + 1 < right.node.size(); ++i)
    EXPECT_TRUE(sides.contains({right.node[i], right.node[i + 1]}));
}

TEST(PoleBand, has_no_facet_at_both_poles) {
  const PoleChain left{{0, 1, 9}, {0, 0.5, 1}}, right{{0, 2, 9}, {0, 0.5, 1}};
  const std::vector<Corners> facets = fill_pole_band(left, right);
  ASSERT_EQ(facets.size(), 2u);
  for (const Corners& c : facets) EXPECT_FALSE(std::ranges::count(c, 0) && std::ranges::count(c, 9));
}

TEST(PoleBand, runs_along_edges_from_pole_to_pole) {
  const Model tip = test::make_model("tip_of_2"), melon = test::make_model("melon");  // of eighths: a pole, and a
                                                                                      // corner
  const auto n = [](const Model& model) { return std::ranges::count(edges_between_poles(model.tables()), 1); };
  EXPECT_EQ(n(tip), 3);
  EXPECT_EQ(n(melon), 0);
}

}  // namespace
}  // namespace st
