// What a face is to the flow: from names, or from its extent.
#include "features/face_roles.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sizing/model_limits.h"

namespace st {
namespace {

/// A body (faces 0, 1) in a domain: face 2 shares an edge with the body, face 3 does not. No names.
ModelTables body_in_domain(double body) {
  ModelTables t;
  t.labels.group_role = {"wall"};
  t.labels.face_group = {0, 0, 0, 0};
  t.face_is_reversed = {0, 0, 0, 0};
  t.face_box = {{{0, 0, 0}, {body, 0, 0}},
                {{0, 0, 0}, {0, body / 2, 0}},
                {{-50, -50, 0}, {50, 50, 0}},
                {{-50, -50, 0}, {-50, 50, 100}}};
  t.face_type.assign(4, SurfaceType::kPlane);
  t.edge_length = {1, 1, 1};
  t.edge_is_degenerate = {0, 0, 0};
  t.face_loop_offsets = {0, 1, 2, 3, 4};
  t.loop_coedge_offsets = {0, 2, 3, 5, 6};
  t.coedge_edge = {0, 1, 0, 1, 2, 2};
  return t;
}

TEST(FaceRoles, find_a_small_body_in_an_unnamed_domain) {
  const FaceRoles roles = face_roles(body_in_domain(2));
  EXPECT_EQ(roles.guessed, (std::vector<FaceId>{2, 3}));
  EXPECT_EQ(roles.role,
            (std::vector<FaceRole>{FaceRole::kWall, FaceRole::kWall, FaceRole::kSymmetry, FaceRole::kFarfield}));
  EXPECT_DOUBLE_EQ(roles.reference_diagonal, std::hypot(2, 1));
}

TEST(FaceRoles, do_not_take_a_wing_for_the_domain_of_its_tip) {
  ModelTables t = body_in_domain(2);
  t.face_type[2] = SurfaceType::kBspline;
  EXPECT_TRUE(face_roles(t).guessed.empty());
}

TEST(FaceRoles, do_not_take_a_plate_for_the_domain_of_its_bore) {
  ModelTables t = body_in_domain(2);
  t.face_box[3] = {{-50, -50, 2}, {50, 50, 2}};
  EXPECT_FALSE(face_roles(t).guessed.empty());
  t.coedge_edge = {0, 1, 0, 1, 2, 0};
  EXPECT_TRUE(face_roles(t).guessed.empty());
}

TEST(FaceRoles, do_not_take_a_large_body_for_the_domain_of_what_sticks_out_of_it) {
  ModelTables t = body_in_domain(2);
  t.face_box[1] = {{0, 0, -1}, {0, 1, 0}};
  EXPECT_TRUE(face_roles(t).guessed.empty());
}

TEST(FaceRoles, do_not_guess_when_the_rest_is_not_small_or_a_name_speaks) {
  EXPECT_TRUE(face_roles(body_in_domain(20)).guessed.empty());
  ModelTables named = body_in_domain(2);
  named.labels.group_role = {"wall", "farfield"};
  named.labels.face_group[3] = 1;
  const FaceRoles roles = face_roles(named);
  EXPECT_TRUE(roles.guessed.empty());
  EXPECT_EQ(roles.role[2], FaceRole::kWall);
}

TEST(FaceRoles, give_a_domain_that_touches_the_body_everywhere_a_far_length_still) {
  ModelTables t = body_in_domain(2);
  t.coedge_edge = {0, 1, 0, 1, 2, 0};
  EXPECT_EQ(face_roles(t).role[3], FaceRole::kSymmetry);
  EXPECT_GT(model_limits(t, face_roles(t), {0.01, 0.5, radians(10), 2}).far_length, 4);
}

TEST(FaceRoles, follow_the_names_of_groups_and_measure_the_walls_alone) {
  ModelTables t = body_in_domain(20);
  t.labels.group_role = {"wall", "symmetry", "farfield", "inlet"};
  t.labels.face_group = {0, 3, 1, 2};
  const FaceRoles roles = face_roles(t);
  EXPECT_EQ(roles.role,
            (std::vector<FaceRole>{FaceRole::kWall, FaceRole::kWall, FaceRole::kSymmetry, FaceRole::kFarfield}));
  EXPECT_TRUE(roles.guessed.empty());
  EXPECT_DOUBLE_EQ(roles.reference_diagonal, std::hypot(20, 10));
}

TEST(FaceRoles, of_a_model_without_a_wall_are_walls_all) {
  ModelTables t = body_in_domain(2);
  t.labels.group_role = {"farfield"};
  const FaceRoles roles = face_roles(t);
  EXPECT_EQ(roles.role, std::vector<FaceRole>(4, FaceRole::kWall));
  EXPECT_GT(roles.reference_diagonal, 100);
}

}  // namespace
}  // namespace st
