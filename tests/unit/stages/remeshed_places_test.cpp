#include "stages/remeshed_places.h"

#include <gtest/gtest.h>

namespace st {
namespace {

/// A row of 6 triangles, each beside the next; the last two of another group.
SurfaceMesh row_of_triangles() {
  SurfaceMesh m;
  for (int i = 0; i < 8; ++i) m.node_xyz.push_back({0.5 * i, i % 2 == 0 ? 0.0 : 1.0, 0});
  for (NodeId i = 0; i < 6; ++i) m.triangles.push_back({{i, i + 1, i + 2}});
  m.triangle_group = {0, 0, 0, 0, 1, 1};
  m.labels.group_name = {"wing", "flap"};
  return m;
}

TEST(RemeshedPlaces, are_what_hangs_together_by_nodes) {
  const SurfaceMesh m = row_of_triangles();
  EXPECT_TRUE(find_remeshed_places(m, std::vector<char>(6, 0)).empty());
  const auto two = find_remeshed_places(m, std::vector<char>{1, 0, 0, 0, 1, 1});
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(two[0].group, 1);
  EXPECT_EQ(two[0].n_triangles, 2);
  EXPECT_EQ(two[1].group, 0);
  EXPECT_EQ(two[1].n_triangles, 1);
  EXPECT_NEAR(two[1].xyz.x, 0.5, 1e-12);
  EXPECT_EQ(find_remeshed_places(m, std::vector<char>{1, 0, 1, 0, 0, 0}).size(), 1u) << "by node 2";
}

TEST(RemeshedPlaces, are_named_with_group_number_and_place) {
  const SurfaceMesh m = row_of_triangles();
  const auto places = find_remeshed_places(m, std::vector<char>{1, 0, 0, 0, 0, 1});
  EXPECT_EQ(places_text(m, places),
            "group wing: 1 triangle at (0.5 0.333333 0); group flap: 1 triangle at (3 "
            "0.666667 0)");
  const auto json = places_json(m, places);
  EXPECT_EQ(json.size(), 2u);
  EXPECT_EQ(json[1].at("group"), "flap");
  EXPECT_EQ(json[1].at("triangles"), 1);
  EXPECT_EQ(places_text(m, std::vector<RemeshedPlace>(12, places[0])).find("and 2 more") == std::string::npos, false);
}

}  // namespace
}  // namespace st
