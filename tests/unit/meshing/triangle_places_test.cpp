#include "meshing/face/triangle_places.h"

#include <gtest/gtest.h>

#include "unit/meshing/grid_patch.h"

namespace st {
namespace {

using test::grid_triangles;

TEST(PlacesAbout, a_triangle_are_the_rings_around_it_with_one_loop) {
  const auto triangles = grid_triangles(8);
  const std::size_t seed = 2 * (8 * 4 + 4);
  const auto places = places_about(triangles, 81, std::vector{seed}, 1);
  ASSERT_EQ(places.size(), 1u);
  EXPECT_EQ(places[0].triangles.size(), 13u);
  EXPECT_EQ(places[0].loop.size(), 9u);
  EXPECT_EQ(places[0].n_seeds, 1);
  EXPECT_EQ(places_about(triangles, 81, std::vector{seed}, 0)[0].loop.size(), 3u);
}

TEST(PlacesAbout, triangles_that_share_a_node_are_one) {
  const auto triangles = grid_triangles(8);
  EXPECT_EQ(places_about(triangles, 81, std::vector<std::size_t>{0, 127}, 1).size(), 2u);
  const auto near = places_about(triangles, 81, std::vector<std::size_t>{0, 1}, 1);
  ASSERT_EQ(near.size(), 1u);
  EXPECT_EQ(near[0].n_seeds, 2);
}

TEST(PlacesAbout, what_is_no_disc_has_no_loop) {
  auto triangles = grid_triangles(3);
  triangles.erase(triangles.begin() + 8, triangles.begin() + 10);  // the square in the middle
  const auto places = places_about(triangles, 16, std::vector<std::size_t>{0, 15}, 3);
  ASSERT_EQ(places.size(), 1u);
  EXPECT_TRUE(places[0].loop.empty());
}

}  // namespace
}  // namespace st
