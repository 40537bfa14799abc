#include "sizing/model_limits.h"

#include <gtest/gtest.h>

namespace st {
namespace {

const SamplingLimits kWall{0.01, 0.5, radians(10), 2};

/// Three faces in a row (wall, symmetry, far field) that share edges 0 (wall-symmetry) and 1 (symmetry-far field); edge
/// 2 belongs to symmetry only, edge 3 to none, edge 4 is degenerate.
ModelTables three_faces(const std::vector<std::string>& roles) {
  ModelTables t;
  t.labels.group_role = roles;
  t.labels.face_group = {0, 1, 2};
  t.face_is_reversed = {0, 0, 0};
  t.face_box = {{{0, 0, 0}, {1, 1, 1}}, {{0, 0, 0}, {100, 0, 100}}, {{0, 0, 0}, {60, 80, 0}}};
  t.edge_length = {1, 1, 1, 1, 0};
  t.edge_is_degenerate = {0, 0, 0, 0, 1};
  t.face_loop_offsets = {0, 1, 2, 3};
  t.loop_coedge_offsets = {0, 2, 5, 6};
  t.coedge_edge = {0, 4, 0, 1, 2, 1};
  return t;
}

ModelLimits limits_of(const ModelTables& t) { return model_limits(t, face_roles(t), kWall); }

TEST(ModelLimits, follow_the_roles_of_groups) {
  const ModelLimits limits = limits_of(three_faces({"wall", "symmetry", "farfield"}));
  ASSERT_TRUE(limits.face[0]);
  EXPECT_EQ(limits.face[0]->max_length, 0.5);
  EXPECT_FALSE(limits.face[1]);
  ASSERT_TRUE(limits.face[2]);
  EXPECT_DOUBLE_EQ(limits.face[2]->max_length, kFarLengthPerDiagonal * 100);
  EXPECT_EQ(limits.face[2]->min_length, kWall.min_length);
  EXPECT_DOUBLE_EQ(limits.far_length, kFarLengthPerDiagonal * 100);
  EXPECT_DOUBLE_EQ(limits.trace(2).max_length, limits.far_length) << "an edge that is not sampled is traced coarsely";
}

TEST(ModelLimits, of_an_edge_are_the_smallest_of_its_faces) {
  const ModelLimits limits = limits_of(three_faces({"wall", "symmetry", "farfield"}));
  EXPECT_EQ(limits.edge[0]->max_length, 0.5);
  EXPECT_DOUBLE_EQ(limits.edge[1]->max_length, kFarLengthPerDiagonal * 100);
  EXPECT_FALSE(limits.edge[2]) << "between symmetry planes only";
  EXPECT_EQ(limits.edge[3]->max_length, 0.5) << "an edge of no face";
  EXPECT_FALSE(limits.edge[4]) << "degenerate";
}

TEST(ModelLimits, never_make_a_far_field_finer_than_walls) {
  ModelTables t = three_faces({"wall", "symmetry", "farfield"});
  t.face_box[2] = {{0, 0, 0}, {0.1, 0, 0}};
  EXPECT_EQ(limits_of(t).face[2]->max_length, kWall.max_length);
}

TEST(ModelLimits, treat_a_model_without_walls_as_one_wall) {
  const ModelLimits limits = limits_of(three_faces({"farfield", "symmetry", "farfield"}));
  for (const auto& face : limits.face) EXPECT_EQ(face->max_length, kWall.max_length);
  EXPECT_EQ(limits.far_length, kWall.max_length);
}

}  // namespace
}  // namespace st
