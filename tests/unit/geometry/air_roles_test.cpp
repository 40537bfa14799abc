// A file with its own air through the import: roles, groups, and what is refused or replaced.
#include "geometry/import/air_roles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "base/error.h"
#include "geometry/import/import.h"
#include "unit/geometry/broken_import.h"

namespace st {
namespace {

ImportOptions with(const std::string& symmetry, const std::string& farfield, const std::string& replaced = "") {
  ImportOptions options;
  options.air.symmetry = symmetry;
  options.air.farfield = farfield;
  options.air.replace_farfield = replaced;
  return options;
}

int n_of_role(const ModelTables& t, const std::string& role) {
  return static_cast<int>(std::count_if(t.labels.face_group.begin(), t.labels.face_group.end(),
                                        [&](std::int32_t g) { return t.labels.group_role[g] == role; }));
}

std::string refusal(const std::string& shape, const ImportOptions& options) {
  try {
    test::import_broken(shape, options);
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kUsage);
    return e.what();
  }
  return "";
}

TEST(AirRoles, are_those_of_groups_and_names_of_the_faces) {
  const ModelTables t = test::import_broken("pod_in_box_50_half").tables;
  EXPECT_EQ(n_of_role(t, "farfield"), 5);
  EXPECT_EQ(n_of_role(t, "symmetry"), 1);
  EXPECT_EQ(std::count(t.labels.face_name.begin(), t.labels.face_name.end(), "farfield"), 5);
  EXPECT_EQ(std::count(t.labels.group_name.begin(), t.labels.group_name.end(), "symmetry"), 1);
}

TEST(AirRoles, of_air_on_both_sides_are_no_walls_in_a_flow_domain) {
  ModelTables t;
  t.face_box = {{{0, 0, 0}, {1, 1, 1}}, {{-2, -2, -2}, {3, 3, 3}}, {{-9, -9, -9}, {9, 9, 9}}};
  t.face_is_reversed = {0, 0, 0};
  t.labels.face_group = {0, 1, 2};
  t.labels.group_role = {"wall", "interface", "farfield"};
  EXPECT_EQ(t.wall_box().hi.x, 1);
  t.labels.group_role = {"wall", "interface", "wall"};
  EXPECT_EQ(t.wall_box().hi.x, 9);
  t.labels.group_role = {"wall", "interface", "symmetry"};
  EXPECT_EQ(t.wall_box().hi.x, 3);
}

TEST(AirRoles, refuse_a_second_far_field_and_a_second_plane_with_the_way_out) {
  const std::string far = refusal("pod_in_box_50_half", with("", "box:20"));
  EXPECT_NE(far.find("5 faces are farfield, 1 face is symmetry"), std::string::npos) << far;
  EXPECT_NE(far.find("--replace-farfield"), std::string::npos) << far;
  EXPECT_NE(far.find("--flow-domain no"), std::string::npos) << far;
  const std::string plane = refusal("pod_in_sphere_50", with("y=0", ""));
  EXPECT_NE(plane.find("--symmetry"), std::string::npos) << plane;
  EXPECT_NE(refusal("housing", with("", "", "box:20")).find("no far field to replace"), std::string::npos);
  EXPECT_NE(refusal("housing", with("", "box:5", "box:20")).find("one of them"), std::string::npos);
}

TEST(AirRoles, a_replaced_far_field_leaves_the_body_and_the_plane_where_they_are) {
  for (const char* shape : {"pod_in_box_50_half", "pod_in_sphere_5_half", "pod_in_c_50"}) {
    const bool is_half = std::string(shape).ends_with("half");
    const ImportResult before = test::import_broken(shape), r = test::import_broken(shape, with("", "", "box:20"));
    EXPECT_TRUE(r.is_closed) << shape;
    EXPECT_TRUE(r.air.is_replaced);
    EXPECT_EQ(r.tables.n_solids, 1);
    EXPECT_EQ(n_of_role(r.tables, "farfield"), is_half ? 5 : 6) << shape;
    EXPECT_EQ(n_of_role(r.tables, "symmetry"), is_half ? 1 : 0) << shape;
    EXPECT_EQ(n_of_role(r.tables, "wall"), n_of_role(before.tables, "wall")) << shape;
    EXPECT_NEAR(r.tables.reference_diagonal(), before.tables.reference_diagonal(), 1e-6);
    EXPECT_GT(*r.tables.volume, 0);
  }
}

TEST(AirRoles, a_replaced_whole_far_field_may_get_a_symmetry_plane) {
  const ImportResult r = test::import_broken("pod_in_c_50", with("y=0", "", "sphere:20"));
  EXPECT_TRUE(r.is_closed);
  EXPECT_EQ(n_of_role(r.tables, "symmetry"), 1);
}

TEST(AirRoles, are_left_to_a_groups_file_that_speaks_of_them) {
  ImportOptions options;
  GroupRule rule;
  rule.where = "groups.toml:1";
  rule.name = "tunnel";
  rule.selection.faces = {"1"};
  rule.role = "farfield";
  options.groups = {rule};
  const ModelTables t = test::import_broken("pod_in_box_50", options).tables;
  EXPECT_EQ(n_of_role(t, "farfield"), 1);
  options.groups[0].selection.faces = {};
  options.groups[0].name = "farfield";
  EXPECT_EQ(n_of_role(test::import_broken("pod_in_box_50", options).tables, "farfield"), 6);
}

}  // namespace
}  // namespace st
