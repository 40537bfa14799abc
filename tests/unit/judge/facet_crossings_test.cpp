#include "judge/facet_crossings.h"

#include <gtest/gtest.h>

namespace st {
namespace {

/// Two faces of one facet each, with nodes of their own.
FacetShape two_facets(const std::vector<Vec3>& first, const std::vector<Vec3>& second) {
  FacetShape shape;
  shape.node_xyz = first;
  shape.node_xyz.insert(shape.node_xyz.end(), second.begin(), second.end());
  shape.triangle_nodes = {{0, 1, 2}, {0, 1, 2}};
  shape.face_node_offsets = {0, 3, 6};
  shape.face_triangle_offsets = {0, 1, 2};
  return shape;
}

TEST(FacetCrossings, are_along_the_line_that_two_facets_have_in_common) {
  const FacetCrossings crossings(two_facets({{0, 0, 0}, {10, 0, 0}, {0, 10, 0}}, {{1, 1, -1}, {1, 1, 2}, {1, 3, -1}}));
  EXPECT_TRUE(crossings.is_near({1, 1, 0}, 0));
  EXPECT_TRUE(crossings.is_near({1, 2, 0}, 0));
  EXPECT_TRUE(crossings.is_near({1.5, 1, 0.5}, 0.6));
  EXPECT_FALSE(crossings.is_near({1.5, 1, 0.5}, 0.4));
  EXPECT_FALSE(crossings.is_near({1, 1, 2}, 0.5)) << "a corner off the line";
}

TEST(FacetCrossings, are_where_facets_of_one_plane_overlap) {
  const FacetCrossings crossings(two_facets({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{1, 1, 0}, {9, 1, 0}, {1, 9, 0}}));
  EXPECT_TRUE(crossings.is_near({1.5, 1.5, 0}, 0));
  EXPECT_FALSE(crossings.is_near({8, 1, 0}, 1));
}

TEST(FacetCrossings, are_none_where_faces_meet_along_a_side) {
  const FacetCrossings crossings(two_facets({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{1, 0, 0}, {0, 0, 0}, {0, 0, 1}}));
  EXPECT_FALSE(crossings.is_near({0.5, 0, 0}, 10));
}

}  // namespace
}  // namespace st
