// What a face is to the flow: from the roles of groups.
#include "features/face_roles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace st {
namespace {

/// A body (faces 0, 1) in a domain (2, 3).
ModelTables body_in_domain(double body) {
  ModelTables t;
  t.labels.group_role = {"wall"};
  t.labels.face_group = {0, 0, 0, 0};
  t.face_is_reversed = {0, 0, 0, 0};
  t.face_box = {{{0, 0, 0}, {body, 0, 0}},
                {{0, 0, 0}, {0, body / 2, 0}},
                {{-50, -50, 0}, {50, 50, 0}},
                {{-50, -50, 0}, {-50, 50, 100}}};
  return t;
}

TEST(FaceRoles, follow_the_roles_of_groups_and_measure_the_walls_alone) {
  ModelTables t = body_in_domain(20);
  t.labels.group_role = {"wall", "symmetry", "farfield", "inlet"};
  t.labels.face_group = {0, 3, 1, 2};
  const FaceRoles roles = face_roles(t);
  EXPECT_EQ(roles.role,
            (std::vector<FaceRole>{FaceRole::kWall, FaceRole::kWall, FaceRole::kSymmetry, FaceRole::kFarfield}));
  EXPECT_DOUBLE_EQ(roles.reference_diagonal, std::hypot(20, 10));
}

TEST(FaceRoles, of_interfaces_are_walls_but_in_a_flow_domain) {
  ModelTables t = body_in_domain(2);
  t.labels.group_role = {"wall", "interface", "farfield"};
  t.labels.face_group = {0, 0, 1, 2};
  EXPECT_EQ(face_roles(t).role[2], FaceRole::kInterface);
  EXPECT_DOUBLE_EQ(face_roles(t).reference_diagonal, std::hypot(2, 1));
  t.labels.face_group = {0, 0, 1, 0};
  EXPECT_EQ(face_roles(t).role[2], FaceRole::kWall);
}

TEST(FaceRoles, of_a_model_without_a_role_are_walls_all) {
  const FaceRoles roles = face_roles(body_in_domain(2));
  EXPECT_EQ(roles.role, std::vector<FaceRole>(4, FaceRole::kWall));
  EXPECT_GT(roles.reference_diagonal, 100);
}

TEST(FaceRoles, of_a_model_without_a_wall_are_walls_all) {
  ModelTables t = body_in_domain(2);
  t.labels.group_role = {"farfield"};
  const FaceRoles roles = face_roles(t);
  EXPECT_EQ(roles.role, std::vector<FaceRole>(4, FaceRole::kWall));
  EXPECT_GT(roles.reference_diagonal, 100);
}

TEST(FaceRoles, of_a_passage_are_periodic_faces_with_an_inlet_or_an_outlet) {
  ModelTables t = body_in_domain(2);
  t.labels.group_role = {"wall", "periodic", "inlet", "outlet", "farfield"};
  for (const auto& [groups, is_passage] : {std::pair{std::vector<std::int32_t>{0, 1, 1, 2}, true},
                                           {{0, 1, 1, 3}, true},
                                           {{0, 1, 1, 0}, false},     // a sector of a machine part
                                           {{0, 0, 2, 3}, false},     // a body with an engine
                                           {{0, 1, 2, 4}, false}}) {  // a far field says it already
    t.labels.face_group = groups;
    EXPECT_EQ(face_roles(t).is_passage, is_passage) << groups[1] << groups[2] << groups[3];
    EXPECT_EQ(is_material_ahead(t, face_roles(t)), is_passage || groups[3] == 4);
  }
}

}  // namespace
}  // namespace st
