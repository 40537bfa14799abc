#include "base/face_labels.h"

#include <gtest/gtest.h>

namespace st {
namespace {

TEST(RoleOf, a_group_is_its_own_or_that_of_its_name) {
  FaceLabels labels;
  labels.group_name = {"far field", "wing"};
  EXPECT_EQ(role_of(labels, 0), "farfield");
  EXPECT_EQ(role_of(labels, 1), "wall");
  labels.group_role = {"wall", "symmetry"};
  EXPECT_EQ(role_of(labels, 0), "wall");
  EXPECT_EQ(role_of(labels, 1), "symmetry");
}

TEST(RoleOfName, knows_whole_words_whatever_their_case_and_separators) {
  for (const char* name : {"sym", "SYM", "symm", "symmetry", "Symmetry_1", "symmetry_plane", "SymmetryPlane", "symm-y0",
                           "wing symmetry", "symplane", "2sym"})
    EXPECT_EQ(role_of_name(name), "symmetry") << name;
  for (const char* name :
       {"farfield", "far_field", "Far Field", "FARFIELD", "FarField", "far-field 2", "outer farfield sphere"})
    EXPECT_EQ(role_of_name(name), "farfield") << name;
}

TEST(RoleOfName, does_not_take_parts_of_words) {
  for (const char* name : {"asymmetry", "symbol", "symmetric", "Asymmetry plane", "farfields", "nearfarfield", "far",
                           "field far", "", "wall", "ésym"})
    EXPECT_EQ(role_of_name(name), "wall") << name;
}

FaceLabels labels() {
  FaceLabels l;
  l.part_name = {"bolt", "bolt", "plate"};
  l.part_path = {"as/bolt#1", "as/bolt#2", "as/plate"};
  l.face_part = {0, 1, 2, kNone};
  l.tables = {{"bc", {"hot", "cold"}, {"wall", "inlet"}, {"{}", "{}"}, {1, kNone, 0, 0}}};
  return l;
}

TEST(FaceLabels, name_the_part_of_a_face_and_nothing_where_there_is_none) {
  EXPECT_EQ(labels().part_of(1), "bolt");
  EXPECT_EQ(labels().path_of(1), "as/bolt#2");
  EXPECT_EQ(labels().path_of(3), "");
  EXPECT_EQ(FaceLabels().part_of(0), "");
}

TEST(FindFaces, prefers_main_groups_then_tables_then_part_names_then_paths) {
  using Mask = std::vector<std::uint8_t>;
  FaceLabels l = labels();
  l.group_name = {"body", "wing"};
  l.face_group = {0, 0, 1, 1};
  EXPECT_EQ(find_faces("w*", l), (Mask{0, 0, 1, 1}));
  EXPECT_EQ(find_faces("hot", l), (Mask{0, 0, 1, 1}));
  EXPECT_EQ(find_faces("bc:cold", l), (Mask{1, 0, 0, 0}));
  EXPECT_EQ(find_faces("bolt", l), (Mask{1, 1, 0, 0}));
  EXPECT_EQ(find_faces("as/bolt#2", l), (Mask{0, 1, 0, 0}));
  EXPECT_TRUE(find_faces("nut", l).empty());
  l.group_name[1] = "bolt";
  EXPECT_EQ(find_faces("bolt", l), (Mask{0, 0, 1, 1})) << "the part of this name is hidden by the group";
}

TEST(FaceLabels, of_selected_faces_come_in_their_order) {
  const std::vector<FaceId> faces = {2, 0};
  FaceLabels all = labels();
  all.face_name = {"a", "b", "c", "d"};
  all.face_group = {0, 0, 1, 1};
  const FaceLabels some = select_labels(all, faces);
  EXPECT_EQ(some.face_name, (std::vector<std::string>{"c", "a"}));
  EXPECT_EQ(some.face_group, (std::vector<std::int32_t>{1, 0}));
  EXPECT_EQ(some.path_of(0), "as/plate");
  EXPECT_EQ(some.path_of(1), "as/bolt#1");
  EXPECT_EQ(some.tables[0].face_group, (std::vector<std::int32_t>{0, 1}));
}

TEST(FaceLabels, of_two_models_keep_parts_apart_and_join_groups_of_one_name) {
  FaceLabels first = labels(), second = labels();
  first.face_name = {"a", "b", "", ""}, second.face_name = {"", "", "", "z"};
  first.group_name = {"body", "wing"}, second.group_name = {"wing", "body"};
  first.group_role = {"wall", "wall"}, second.group_role = {"wall", "farfield"};
  first.face_group = {0, 0, 1, 1}, second.face_group = {0, 1, 1, 1};
  first.group_attributes = {}, second.group_attributes = {"{}", "{\"a\":1}"};
  second.tables[0].group_name = {"cold", "new"};
  second.tables[0].group_role = {"inlet", "wall"};
  const FaceLabels both = append_labels(first, 4, second, 4);
  EXPECT_EQ(both.part_path, (std::vector<std::string>{"as/bolt#1", "as/bolt#2", "as/plate", "as/bolt#1#2",
                                                      "as/bolt#2#2", "as/plate#2"}));
  EXPECT_EQ(both.face_part, (std::vector<std::int32_t>{0, 1, 2, kNone, 3, 4, 5, kNone}));
  EXPECT_EQ(both.face_name, (std::vector<std::string>{"a", "b", "", "", "", "", "", "z"}));
  EXPECT_EQ(both.group_name, (std::vector<std::string>{"body", "wing", "body"}));
  EXPECT_EQ(both.face_group, (std::vector<std::int32_t>{0, 0, 1, 1, 1, 2, 2, 2}));
  EXPECT_EQ(both.group_attributes, (std::vector<std::string>{"{}", "{}", "{\"a\":1}"}));
  EXPECT_EQ(both.tables[0].group_name, (std::vector<std::string>{"hot", "cold", "new"}));
  EXPECT_EQ(both.tables[0].face_group, (std::vector<std::int32_t>{1, kNone, 0, 0, 2, kNone, 1, 1}));
}

TEST(FaceLabels, of_a_model_that_has_none_are_filled_up) {
  const FaceLabels both = append_labels(FaceLabels(), 2, labels(), 4);
  EXPECT_EQ(both.face_part, (std::vector<std::int32_t>{kNone, kNone, 0, 1, 2, kNone}));
  EXPECT_EQ(both.tables[0].face_group, (std::vector<std::int32_t>{kNone, kNone, 1, kNone, 0, 0}));
  const FaceLabels turned = append_labels(labels(), 4, FaceLabels(), 1);
  EXPECT_EQ(turned.face_part, (std::vector<std::int32_t>{0, 1, 2, kNone, kNone}));
  EXPECT_EQ(turned.tables[0].face_group.size(), 5u);
}

std::vector<EntityGroup> edge_groups() {
  return {{"te", "", "{}", {2, 5}}, {"root", "", "{}", {3}}, {"te", "bc", R"({"a":1})", {0, 5}}};
}

TEST(EntityGroups, are_found_in_the_main_table_first_and_by_the_name_of_their_table) {
  using Ids = std::vector<std::int32_t>;
  EXPECT_EQ(find_members("te", edge_groups()), (Ids{2, 5}));
  EXPECT_EQ(find_members("*", edge_groups()), (Ids{2, 3, 5}));
  EXPECT_EQ(find_members("bc:t?", edge_groups()), (Ids{0, 5}));
  EXPECT_TRUE(find_members("tip", edge_groups()).empty());
}

TEST(EntityGroups, of_a_part_have_its_numbers_and_those_without_any_go) {
  const std::vector<std::int32_t> place = {kNone, kNone, 1, kNone, kNone, 0};
  const std::vector<EntityGroup> part = select_groups(edge_groups(), place);
  ASSERT_EQ(part.size(), 2u);
  EXPECT_EQ(part[0], (EntityGroup{"te", "", "{}", {0, 1}}));
  EXPECT_EQ(part[1], (EntityGroup{"te", "bc", R"({"a":1})", {0}}));
}

TEST(EntityGroups, of_two_models_are_one_where_name_and_table_agree) {
  std::vector<EntityGroup> both = edge_groups();
  append_groups(both, {{"te", "", "{}", {1}}, {"tip", "", "{}", {0}}}, 6);
  ASSERT_EQ(both.size(), 4u);
  EXPECT_EQ(both[0].ids, (std::vector<std::int32_t>{2, 5, 7}));
  EXPECT_EQ(both[3], (EntityGroup{"tip", "", "{}", {6}}));
}

TEST(FaceTolerances, are_the_largest_that_any_table_gives) {
  FaceLabels l = labels();
  l.group_name = {"body", "far"};
  l.face_group = {0, 0, 1, 1};
  EXPECT_TRUE(face_tolerances(l).empty());
  l.group_attributes = {"{}", R"({"tolerance":0.5,"x":"y"})"};
  l.tables[0].group_attributes = {R"({"tolerance":2})", R"({"tolerance":0.25})"};
  EXPECT_EQ(face_tolerances(l), (std::vector<double>{0.25, 0, 2, 2}));
}

}  // namespace
}  // namespace st
