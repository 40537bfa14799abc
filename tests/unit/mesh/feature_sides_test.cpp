#include "mesh/feature_sides.h"

#include <gtest/gtest.h>

namespace st {
namespace {

using Sides = std::vector<std::array<NodeId, 2>>;

/// Two triangles over the side 0-1 that turn by `angle`, the second one turned over where `is_alike` is not.
SurfaceMesh folded(double angle_deg, bool is_turned = false) {
  SurfaceMesh m;
  const double a = radians(angle_deg);
  m.node_xyz = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -std::cos(a), std::sin(a)}};
  m.triangles = {{{0, 1, 2}}, {{1, 0, 3}}};
  if (is_turned) std::swap(m.triangles[1].n[0], m.triangles[1].n[1]);
  m.triangle_face = {0, 1};
  m.triangle_group = {0, 0};
  m.labels.group_name = {"a", "b"};
  return m;
}

const Sides kOpen = {{0, 2}, {0, 3}, {1, 2}, {1, 3}};

TEST(FeatureSides, are_those_where_normals_turn_enough_however_triangles_are_oriented) {
  for (const bool is_turned : {false, true}) {
    EXPECT_EQ(feature_sides(folded(29, is_turned), 30), kOpen);
    EXPECT_EQ(feature_sides(folded(31, is_turned), 30), (Sides{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}}));
  }
}

TEST(FeatureSides, lie_between_groups) {
  SurfaceMesh m = folded(0);
  m.triangle_group = {0, 1};
  EXPECT_EQ(feature_sides(m, 30)[0], (std::array<NodeId, 2>{0, 1}));
}

TEST(FeatureSides, are_those_of_three_triangles_and_none_of_an_empty_mesh) {
  SurfaceMesh m = folded(0);
  m.node_xyz.push_back({0, 0, -1});
  m.triangles.push_back({{0, 1, 4}});
  m.triangle_group.push_back(0);
  EXPECT_EQ(feature_sides(m, 180).size(), 7u);
  EXPECT_TRUE(feature_sides(SurfaceMesh(), 30).empty());
}

}  // namespace
}  // namespace st
