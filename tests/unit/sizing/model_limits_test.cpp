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

TEST(ModelLimits, of_a_face_with_air_on_both_sides_are_none) {
  const ModelLimits limits = limits_of(three_faces({"wall", "interface", "farfield"}));
  EXPECT_TRUE(limits.face[0]);
  EXPECT_FALSE(limits.face[1]);
  EXPECT_FALSE(limits.edge[2]);
}

TEST(ModelLimits, of_an_edge_are_the_smallest_of_its_faces) {
  const ModelLimits limits = limits_of(three_faces({"wall", "symmetry", "farfield"}));
  EXPECT_EQ(limits.edge[0]->max_length, 0.5);
  EXPECT_DOUBLE_EQ(limits.edge[1]->max_length, kFarLengthPerDiagonal * 100);
  EXPECT_FALSE(limits.edge[2]) << "between symmetry planes only";
  EXPECT_EQ(limits.edge[3]->max_length, 0.5) << "an edge of no face";
  EXPECT_FALSE(limits.edge[4]) << "degenerate";
}

TEST(ModelLimits, stretch_lifting_surfaces_alone_by_more_than_16) {
  SamplingLimits wall = kWall;
  wall.max_aspect = 100;
  ModelTables t = three_faces({"wall", "wall", "wall"});
  t.labels.face_name = {"body", "wing", "strut"};
  const FaceRoles roles = face_roles(t);
  Aircraft aircraft;
  aircraft.wings.emplace_back().faces = {1};
  SizeRule rule;
  rule.selection.faces = {"strut"};
  rule.max_aspect = 40;
  const ModelLimits limits = model_limits(t, roles, wall, {rule}, {}, aircraft);
  EXPECT_EQ(limits.face[0]->max_aspect, 16);
  EXPECT_EQ(limits.face[1]->max_aspect, 100);
  EXPECT_EQ(limits.face[2]->max_aspect, 40) << "a rule says so";
  wall.max_aspect = 4;
  EXPECT_EQ(model_limits(t, roles, wall).face[0]->max_aspect, 4);
}

TEST(ModelLimits, never_make_a_far_field_finer_than_walls) {
  ModelTables t = three_faces({"wall", "symmetry", "farfield"});
  t.face_box[2] = {{0, 0, 0}, {0.1, 0, 0}};
  EXPECT_EQ(limits_of(t).face[2]->max_length, kWall.max_length);
}

/// The limits of a wall with a body's measures in a model of diagonal 20, with a wing's chord beside it.
SamplingLimits limits_of_body(const Body& body) {
  ModelTables t = three_faces({"wall", "wall", "wall"});
  FaceRoles roles{{FaceRole::kWall, FaceRole::kWall, FaceRole::kWall}, 20, {}};
  SamplingLimits wall = kWall;
  wall.chord_cells = 30;
  return *model_limits(t, roles, wall, {}, {}, {{}, {{body}, {0, kNone, kNone}}}).face[0];
}

TEST(ModelLimits, of_a_body_refer_to_its_own_diagonal) {
  EXPECT_DOUBLE_EQ(limits_of_body({.diagonal = 10, .girth = 100, .chord = 3}).max_length, 0.25);
  EXPECT_DOUBLE_EQ(limits_of_body({.diagonal = 30, .girth = 100, .chord = 3}).max_length, 0.5) << "never coarser";
}

TEST(ModelLimits, of_a_body_allow_36_lengths_around_it) {
  EXPECT_NEAR(limits_of_body({.diagonal = 20, .girth = 9, .chord = 3}).max_length, 0.24, 0.01);
  EXPECT_LT(limits_of_body({.diagonal = 20, .girth = 9, .chord = 3}).max_length, 0.25);
}

TEST(ModelLimits, of_a_body_are_no_finer_than_the_wing) {
  EXPECT_DOUBLE_EQ(limits_of_body({.diagonal = 2, .girth = 1, .chord = 12}).max_length, 0.4);
}

TEST(ModelLimits, of_a_body_thinner_than_the_chord_allow_more_turning) {
  EXPECT_DOUBLE_EQ(limits_of_body({.diagonal = 2, .girth = 4, .chord = 3}).alpha, kWall.alpha);
  EXPECT_DOUBLE_EQ(limits_of_body({.diagonal = 2, .girth = 4, .chord = 9}).alpha, 1.5 * kWall.alpha);
  EXPECT_DOUBLE_EQ(limits_of_body({.diagonal = 2, .girth = 1, .chord = 9}).alpha, 2 * kWall.alpha);
  EXPECT_DOUBLE_EQ(limits_of_body({.diagonal = 2, .girth = 1, .chord = 9, .is_wing_piece = true}).alpha, kWall.alpha);
}

TEST(ModelLimits, treat_a_model_without_walls_as_one_wall) {
  const ModelLimits limits = limits_of(three_faces({"farfield", "symmetry", "farfield"}));
  for (const auto& face : limits.face) EXPECT_EQ(face->max_length, kWall.max_length);
  EXPECT_EQ(limits.far_length, kWall.max_length);
}

}  // namespace
}  // namespace st
