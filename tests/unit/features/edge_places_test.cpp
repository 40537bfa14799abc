// Places along edges.
#include "features/edge_places.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace st {
namespace {

TEST(EdgePlaces, stand_for_equal_parts_of_each_edge) {
  const Model model = test::make_model("sharp_wing");
  const std::vector<WingEdge> edges = find_wing_edges(model, face_roles(model.tables()), find_strips(model));
  const std::vector<EdgePlace> places = places_along(model, edges);
  ASSERT_EQ(places.size(), kPlacesPerEdge * edges.size());
  double way = 0, length = 0;
  for (const EdgePlace& place : places) way += place.way;
  for (const WingEdge& w : edges) length += w.length;
  EXPECT_NEAR(way, length, 1e-9 * length);
  EXPECT_NEAR(places.front().share, 0.5 / kPlacesPerEdge, 1e-12);
  EXPECT_NEAR(norm(places.front().tangent), 1, 1e-12);
}

TEST(EdgePlaces, have_the_upper_one_of_two_medians) {
  EXPECT_EQ(median({}), 0);
  EXPECT_EQ(median({3, 1}), 3);
  EXPECT_EQ(median({5, 1, 2}), 2);
}

}  // namespace
}  // namespace st
