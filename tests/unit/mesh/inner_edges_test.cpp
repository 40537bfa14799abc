#include "mesh/inner_edges.h"

#include <gtest/gtest.h>

#include <utility>

namespace st {
namespace {

/// Four triangles around the node 4, which is the only one inside.
FacePatch fan_of_four() {
  FacePatch patch;
  patch.n_boundary = 4;
  patch.inner_xyz = {{0, 0, 0}};
  for (NodeId n = 0; n < 4; ++n) patch.triangles.push_back({{n, (n + 1) % 4, 4}});
  return patch;
}

void expect_counts(const FacePatch& patch, std::int64_t n_open, std::int64_t n_nonmanifold, std::int64_t n_misoriented,
                   bool is_balanced) {
  const InnerEdges found = count_inner_edges(patch);
  EXPECT_EQ(found.n_open, n_open);
  EXPECT_EQ(found.n_nonmanifold, n_nonmanifold);
  EXPECT_EQ(found.n_misoriented, n_misoriented);
  EXPECT_EQ(found.is_balanced, is_balanced);
}

TEST(InnerEdges, a_fan_has_no_defect_inside_and_its_rim_does_not_count) { expect_counts(fan_of_four(), 0, 0, 0, true); }

TEST(InnerEdges, a_missing_triangle_leaves_two_edges_open) {
  FacePatch patch = fan_of_four();
  patch.triangles.pop_back();
  expect_counts(patch, 2, 0, 0, false);
}

TEST(InnerEdges, a_turned_triangle_disagrees_at_two_edges) {
  FacePatch patch = fan_of_four();
  std::swap(patch.triangles[1].n[0], patch.triangles[1].n[1]);
  expect_counts(patch, 0, 0, 2, false);
}

TEST(InnerEdges, a_triangle_that_is_there_twice_has_edges_of_three_triangles) {
  FacePatch patch = fan_of_four();
  patch.triangles.push_back(patch.triangles[2]);
  expect_counts(patch, 0, 2, 0, false);
}

TEST(InnerEdges, a_triangle_with_a_repeated_node_is_none) {
  FacePatch patch = fan_of_four();
  patch.triangles.push_back({{4, 4, 0}});
  expect_counts(patch, 0, 0, 0, true);
}

}  // namespace
}  // namespace st
