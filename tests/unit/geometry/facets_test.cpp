// Coarse triangles of faces.
#include "geometry/model/facets.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/shapes.h"

namespace st {
namespace {

TEST(Facets, of_neighbours_share_their_nodes) {
  const Model model = test::make_model("box");
  const std::vector<std::uint8_t> all(6, 1);
  const Facets facets = make_facets(model, all, {.deflection = 0.1});
  EXPECT_EQ(facets.triangle.size(), 12u);
  std::vector<std::int32_t> nodes;
  for (const auto& t : facets.triangle) nodes.insert(nodes.end(), t.begin(), t.end());
  std::sort(nodes.begin(), nodes.end());
  EXPECT_EQ(std::unique(nodes.begin(), nodes.end()) - nodes.begin(), 8);
}

}  // namespace
}  // namespace st
