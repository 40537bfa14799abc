#include "mesh/pair_match.h"

#include <gtest/gtest.h>

namespace st {
namespace {

/// Two unit squares of two triangles each, at z = 0 and z = 1, with diagonals that are images or not.
SurfaceMesh two_squares(bool same_diagonal) {
  SurfaceMesh m;
  for (const double z : {0.0, 1.0})
    for (const Vec3 x : {Vec3{0, 0, z}, Vec3{1, 0, z}, Vec3{1, 1, z}, Vec3{0, 1, z}}) m.node_xyz.push_back(x);
  m.triangles = {{{0, 1, 2}}, {{0, 2, 3}}};
  if (same_diagonal)
    m.triangles.insert(m.triangles.end(), {{{4, 6, 5}}, {{4, 7, 6}}});
  else
    m.triangles.insert(m.triangles.end(), {{{4, 7, 5}}, {{5, 7, 6}}});
  m.triangle_face = {0, 0, 1, 1};
  return m;
}

const FacePair kUp{0, 1, {.translation = {0, 0, 1}}};

TEST(PairMatch, puts_nodes_side_by_side) {
  const SurfaceMesh m = two_squares(true);
  const PairMatch match = match_pair(m, kUp, pair_tolerance(m));
  EXPECT_EQ(match.nodes, (std::vector<std::pair<NodeId, NodeId>>{{0, 4}, {1, 5}, {2, 6}, {3, 7}}));
  EXPECT_TRUE(match.alone.empty());
  EXPECT_TRUE(match.triangles_alone.empty());
}

TEST(PairMatch, allows_for_the_rounding_of_large_coordinates) {
  SurfaceMesh m = two_squares(true);
  EXPECT_LT(pair_tolerance(m), 2e-12);
  for (Vec3& x : m.node_xyz) x.x += 1e6;
  EXPECT_GT(pair_tolerance(m), 1e-10);  // its last digit
  EXPECT_LT(pair_tolerance(m), 1e-8);
}

TEST(PairMatch, tells_of_other_triangles_between_the_same_nodes) {
  const SurfaceMesh m = two_squares(false);
  EXPECT_EQ(match_pair(m, kUp, pair_tolerance(m)).triangles_alone, (std::vector<TriangleId>{0, 1, 2, 3}));
}

TEST(PairMatch, tells_of_nodes_that_are_off_on_both_sides) {
  SurfaceMesh m = two_squares(true);
  m.node_xyz[6].x += 1e-9;
  EXPECT_EQ(match_pair(m, kUp, pair_tolerance(m)).alone, (std::vector<NodeId>{2, 6}));
  EXPECT_TRUE(match_pair(m, kUp, 1e-8).alone.empty());
}

}  // namespace
}  // namespace st
