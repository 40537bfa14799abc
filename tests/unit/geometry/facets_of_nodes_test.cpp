// Which facets have a node.
#include "geometry/facet/facets_of_nodes.h"

#include <gtest/gtest.h>

#include <vector>

namespace st {
namespace {

TEST(FacetsOfNodes, are_those_with_the_node_ascending) {
  const std::vector<Corners> corners = {{0, 1, 2}, {2, 1, 3}, {4, 3, 1}};  // node 5 has none
  const FacetsOfNodes facets(corners, 6);
  const std::vector<std::vector<std::int32_t>> expected = {{0}, {0, 1, 2}, {0, 1}, {1, 2}, {2}, {}};
  for (std::int32_t node = 0; node < 6; ++node) {
    const auto own = facets.of(node);
    EXPECT_EQ(std::vector<std::int32_t>(own.begin(), own.end()), expected[node]) << node;
  }
}

}  // namespace
}  // namespace st
